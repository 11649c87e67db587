#include "lib/cl/buffer.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "lib/cl/errors.hpp"

namespace powercell::cl {
namespace {

constexpr std::size_t smallest_allocation = 16;  // makes an empty buffer a valid argument

void release(cl_mem& memory) {
  if (memory) clReleaseMemObject(memory);
  memory = nullptr;
}

std::string allocation_text(std::size_t bytes, const DeviceInfo& device) {
  return "allocating " + std::to_string(bytes) + " bytes on " + device.name;
}

}  // namespace

RawBuffer::RawBuffer(RawBuffer&& other) noexcept
    : context_(std::move(other.context_)),
      memory_(std::exchange(other.memory_, nullptr)),
      bytes_(std::exchange(other.bytes_, 0)),
      staged_(std::move(other.staged_)) {}

RawBuffer& RawBuffer::operator=(RawBuffer&& other) noexcept {
  if (this == &other) return *this;
  release(memory_);
  context_ = std::move(other.context_);
  memory_ = std::exchange(other.memory_, nullptr);
  bytes_ = std::exchange(other.bytes_, 0);
  staged_ = std::move(other.staged_);
  return *this;
}

RawBuffer::~RawBuffer() {
  release(memory_);
}

void RawBuffer::require_inside(std::size_t offset, std::size_t bytes) const {
  if (offset <= bytes_ && bytes <= bytes_ - offset) return;
  throw Error(ErrorCode::internal, "bytes " + std::to_string(offset) + " to " +
                                       std::to_string(offset + bytes) + " of a buffer of " +
                                       std::to_string(bytes_));
}

void RawBuffer::reserve(std::size_t bytes) {
  bytes = std::max(bytes, smallest_allocation);
  if (bytes <= bytes_) return;
  const DeviceInfo& device = context_->info();
  if (bytes > device.largest_allocation)
    throw Error(ErrorCode::out_of_device_memory, allocation_text(bytes, device) +
                                                     ": its largest single allocation is " +
                                                     std::to_string(device.largest_allocation) + " bytes");
  // The old memory goes first: the contents need not survive, and both might not fit.
  release(memory_);
  bytes_ = 0;
  cl_int status = CL_SUCCESS;
  memory_ = clCreateBuffer(context_->context(), CL_MEM_READ_WRITE, bytes, nullptr, &status);
  const std::string what = allocation_text(bytes, device);
  check_allocation(status, what);
  // Drivers may delay the allocation until first use. Moving it to the device now makes a failure appear
  // here, where its cause is known and smaller chunks can be tried.
  status = clEnqueueMigrateMemObjects(context_->queue(), 1, &memory_, CL_MIGRATE_MEM_OBJECT_CONTENT_UNDEFINED,
                                      0, nullptr, nullptr);
  if (status != CL_SUCCESS) release(memory_);
  check_allocation(status, what);
  bytes_ = bytes;
}

void RawBuffer::write(const void* from, std::size_t bytes, std::size_t offset) {
  require_inside(offset, bytes);
  if (bytes == 0) return;
  if (bytes <= StagedWrite::most_bytes) {
    std::memcpy(staged_.stage(bytes), from, bytes);
    return staged_.enqueue(*context_, memory_, offset);
  }
  check(clEnqueueWriteBuffer(context_->queue(), memory_, CL_TRUE, offset, bytes, from, 0, nullptr, nullptr),
        "writing " + std::to_string(bytes) + " bytes to " + context_->info().name);
}

void RawBuffer::read(void* to, std::size_t bytes, std::size_t offset) const {
  require_inside(offset, bytes);
  if (bytes == 0) return;
  check(clEnqueueReadBuffer(context_->queue(), memory_, CL_TRUE, offset, bytes, to, 0, nullptr, nullptr),
        "reading " + std::to_string(bytes) + " bytes from " + context_->info().name);
  context_->check_writes();
}

void RawBuffer::fill(std::size_t bytes, const std::function<void(std::byte*)>& writer) {
  require_inside(0, bytes);
  if (bytes == 0) return;
  if (bytes <= StagedWrite::most_bytes) {
    writer(staged_.stage(bytes));
    return staged_.enqueue(*context_, memory_, 0);
  }
  const std::string what = "filling " + std::to_string(bytes) + " bytes on " + context_->info().name;
  cl_int status = CL_SUCCESS;
  void* const mapped = clEnqueueMapBuffer(context_->queue(), memory_, CL_TRUE, CL_MAP_WRITE_INVALIDATE_REGION,
                                          0, bytes, 0, nullptr, nullptr, &status);
  check_allocation(status, what);
  const auto unmap = [&] {
    return clEnqueueUnmapMemObject(context_->queue(), memory_, mapped, 0, nullptr, nullptr);
  };
  try {
    writer(static_cast<std::byte*>(mapped));
  } catch (...) {
    unmap();
    throw;
  }
  check(unmap(), what);
}

Mapping::Mapping(const RawBuffer& buffer, std::size_t bytes)
    : context_(buffer.context()), memory_(buffer.handle()) {
  buffer.require_inside(0, bytes);
  if (bytes == 0) return;
  cl_int status = CL_SUCCESS;
  data_ = static_cast<std::byte*>(clEnqueueMapBuffer(context_->queue(), memory_, CL_TRUE, CL_MAP_READ, 0,
                                                     bytes, 0, nullptr, nullptr, &status));
  check_allocation(status,
                   "reading " + std::to_string(bytes) + " bytes in place from " + context_->info().name);
  try {
    context_->check_writes();
  } catch (...) {
    clEnqueueUnmapMemObject(context_->queue(), memory_, data_, 0, nullptr, nullptr);
    throw;
  }
}

Mapping::Mapping(Mapping&& other) noexcept
    : context_(std::move(other.context_)),
      memory_(other.memory_),
      data_(std::exchange(other.data_, nullptr)) {}

Mapping::~Mapping() {
  if (data_) clEnqueueUnmapMemObject(context_->queue(), memory_, data_, 0, nullptr, nullptr);
}

void Mapping::end() {
  if (!data_) return;
  check(
      clEnqueueUnmapMemObject(context_->queue(), memory_, std::exchange(data_, nullptr), 0, nullptr, nullptr),
      "giving memory back to " + context_->info().name);
}

void RawBuffer::fill_zero(std::size_t bytes) {
  require_inside(0, bytes);
  if (bytes == 0) return;
  const cl_uint zeros[4] = {0, 0, 0, 0};
  // The widest pattern that divides the size: some drivers fill pattern by pattern.
  const std::size_t pattern = bytes % 16 == 0 ? 16 : bytes % 4 == 0 ? 4 : 1;
  check(clEnqueueFillBuffer(context_->queue(), memory_, zeros, pattern, 0, bytes, 0, nullptr, nullptr),
        "clearing " + std::to_string(bytes) + " bytes on " + context_->info().name);
}

}  // namespace powercell::cl
