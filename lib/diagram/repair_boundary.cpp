#include "lib/diagram/repair_boundary.hpp"

#include <string>
#include <vector>

#include "lib/cl/transfers.hpp"

namespace powercell {
namespace {

/// \throw Error invalid_argument
[[noreturn]] void refuse_room(const char* which, std::size_t entries, std::uint32_t room, const char* why) {
  throw Error(ErrorCode::invalid_argument,
              std::string("the ") + which + "boundary walls have " + std::to_string(entries) +
                  " entries, and their buffers have room for " + std::to_string(room) + why +
                  "; enqueue the diagram again with larger ones, and repair that");
}

}  // namespace

BoundaryWalls read_boundary(const std::shared_ptr<cl::Context>& context, const DeviceBoundaryWalls& from,
                            std::uint32_t n, bool float32, std::uint32_t room) {
  std::vector<cl_uint> offset(std::size_t{n} + 1);
  cl::Reads of_offsets(context);
  of_offsets.add(from.offset, offset.data(), offset.size() * sizeof(cl_uint));
  of_offsets.wait();
  BoundaryWalls walls;
  walls.offset.assign(offset.begin(), offset.end());
  const std::size_t entries = offset.back();
  if (entries > room) refuse_room("", entries, room, ", so that some rows were not written");
  if (entries == 0) return walls;
  walls.facet.resize(entries);
  walls.measure.resize(entries);
  std::vector<float> narrow(float32 ? entries : 0);
  cl::Reads reads(context);
  reads.add(from.facet, walls.facet.data(), entries * sizeof(cl_uint));
  if (float32)
    reads.add(from.measure, narrow.data(), entries * sizeof(float));
  else
    reads.add(from.measure, walls.measure.data(), entries * sizeof(double));
  reads.wait();
  if (float32) walls.measure.assign(narrow.begin(), narrow.end());
  return walls;
}

BoundaryWalls merge_boundary(const BoundaryWalls& all, std::span<const std::uint32_t> listed,
                             const BoundaryWalls& exact) {
  constexpr std::uint32_t none = 0xffffffffu;
  const std::size_t n = all.offset.size() - 1;
  std::vector<std::uint32_t> place(n, none);
  for (std::uint32_t k = 0; k < listed.size(); ++k) place[listed[k]] = k;
  BoundaryWalls to;
  to.offset.reserve(n + 1);
  to.offset.push_back(0);
  for (std::size_t i = 0; i < n; ++i) {
    const BoundaryWalls& from = place[i] == none ? all : exact;
    const std::size_t row = place[i] == none ? i : place[i];
    for (std::uint64_t k = from.offset[row]; k < from.offset[row + 1]; ++k) {
      to.facet.push_back(from.facet[k]);
      to.measure.push_back(from.measure[k]);
    }
    to.offset.push_back(to.facet.size());
  }
  return to;
}

void require_room(const BoundaryWalls& walls, std::uint32_t room) {
  if (walls.facet.size() > room) refuse_room("repaired ", walls.facet.size(), room, "");
}

void write_boundary(const cl::Context& context, const DeviceBoundaryWalls& to, const BoundaryWalls& walls,
                    bool float32) {
  const auto write = [&](cl_mem memory, const auto& values) {
    if (values.empty()) return;
    cl::check(cl::clEnqueueWriteBuffer(context.queue(), memory, CL_TRUE, 0, values.size() * sizeof values[0],
                                       values.data(), 0, nullptr, nullptr),
              "writing repaired boundary walls to the caller's buffer");
  };
  write(to.offset, std::vector<cl_uint>(walls.offset.begin(), walls.offset.end()));
  write(to.facet, walls.facet);
  float32 ? write(to.measure, std::vector<float>(walls.measure.begin(), walls.measure.end()))
          : write(to.measure, walls.measure);
}

}  // namespace powercell
