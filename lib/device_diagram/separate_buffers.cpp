#include "lib/device_diagram/separate_buffers.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <powercell/error.hpp>
#include <string>
#include <vector>

#include "lib/cl/context.hpp"

namespace powercell {
namespace {

/// The bytes [begin, end) of a memory object that is no part of another, or of the host if `of` is null.
struct Range {
  cl_mem of;
  std::uintptr_t begin, end;
  const CallersBuffer* buffer;
};

template <class T>
T property(const CallersBuffer& buffer, cl_mem_info which) {
  T value{};
  cl::check(cl::clGetMemObjectInfo(buffer.memory, which, sizeof value, &value, nullptr),
            std::string("asking the caller's buffer of ") + buffer.name + " for a property");
  return value;
}

Range range_of(const CallersBuffer& buffer) {
  const auto size = property<std::size_t>(buffer, CL_MEM_SIZE);
  if (property<cl_mem_flags>(buffer, CL_MEM_FLAGS) & CL_MEM_USE_HOST_PTR) {
    const auto host = reinterpret_cast<std::uintptr_t>(property<void*>(buffer, CL_MEM_HOST_PTR));
    return {nullptr, host, host + size, &buffer};
  }
  const auto whole = property<cl_mem>(buffer, CL_MEM_ASSOCIATED_MEMOBJECT);
  const auto begin = property<std::size_t>(buffer, CL_MEM_OFFSET);
  return {whole ? whole : buffer.memory, begin, begin + size, &buffer};
}

[[noreturn]] void refuse(const CallersBuffer& a, const CallersBuffer& b) {
  const CallersBuffer& written = a.written ? a : b;
  const CallersBuffer& other = a.written ? b : a;
  throw Error(ErrorCode::invalid_argument,
              std::string("the buffers of ") + written.name + " and of " + other.name +
                  " share memory, and " + written.name +
                  " are written while it is in use; give each memory of its own");
}

}  // namespace

void require_separate(std::span<const CallersBuffer> buffers) {
  std::vector<Range> ranges;
  for (const CallersBuffer& buffer : buffers)
    if (buffer.memory) ranges.push_back(range_of(buffer));
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) {
    return a.of != b.of ? std::less<>()(a.of, b.of) : a.begin < b.begin;
  });
  // The range that reaches farthest of all before, and that of those written.
  const Range *any = nullptr, *written = nullptr;
  for (const Range& range : ranges) {
    if (any && any->of != range.of) any = written = nullptr;
    const Range* const before = range.buffer->written ? any : written;
    if (before && before->end > range.begin) refuse(*before->buffer, *range.buffer);
    if (!any || any->end < range.end) any = &range;
    if (range.buffer->written && (!written || written->end < range.end)) written = &range;
  }
}

}  // namespace powercell
