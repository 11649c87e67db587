#include "lib/primitives/scan.hpp"

#include <string>

namespace powercell {

namespace {

constexpr std::uint32_t tile = 128;  // SCAN_TILE of kernels/primitives/scan.cl

std::shared_ptr<const cl::Program> scan_program(cl::Context& context, ExclusiveScan::Type type) {
  return context.program("primitives/scan.cl",
                         {type == ExclusiveScan::Type::uint64 ? "SCAN_BITS=64" : "SCAN_BITS=32"});
}

std::uint32_t tiles_of(std::uint32_t count) {
  return count / tile + (count % tile != 0 ? 1 : 0);
}

}  // namespace

ExclusiveScan::ExclusiveScan(const std::shared_ptr<cl::Context>& context, Type type)
    : value_bytes_(type == Type::uint64 ? 8 : 4),
      sum_(context, scan_program(*context, type), "sum_tiles"),
      scan_(context, scan_program(*context, type), "scan_tiles"),
      sums_(context) {}

void ExclusiveScan::enqueue(cl_mem values, std::uint32_t count, std::size_t local) {
  if (count == 0) return;
  std::size_t entries = 0;
  for (std::uint32_t n = tiles_of(count); n > 1; n = tiles_of(n)) entries += n;
  sums_.reserve(entries * value_bytes_);
  scan_level(values, 0, count, 0, local);
}

void ExclusiveScan::scan_level(cl_mem values, std::uint32_t from, std::uint32_t count, std::uint32_t to,
                               std::size_t local) {
  const std::uint32_t tiles = tiles_of(count);
  if (tiles > 1) {
    sum_.args(tiles, count, values, from, sums_, to).submit(tiles, local);
    scan_level(sums_.handle(), to, tiles, to + tiles, local);
  }
  scan_.args(tiles, count, values, from, sums_, to).submit(tiles, local);
}

Compaction::Compaction(const std::shared_ptr<cl::Context>& context)
    : mark_(context, context->program("primitives/compact.cl", {}), "mark_wanted"),
      list_(context, context->program("primitives/compact.cl", {}), "list_marked"),
      scan_(context, ExclusiveScan::Type::uint32),
      places_(context) {}

void Compaction::enqueue(cl_mem values, std::uint32_t count, std::uint32_t wanted, cl_mem indices,
                         std::uint32_t room, cl_mem found, std::size_t local, cl_event* done) {
  const std::size_t places = std::size_t{count} + 1;
  places_.reserve(places * sizeof(cl_uint));
  mark_.args(count, values, wanted, places_).submit(places, local);
  scan_.enqueue(places_.handle(), count + 1, local);
  list_.args(count, places_, room, indices, found).submit(places, local, done);
}

}  // namespace powercell
