#include "lib/primitives/radix_sort.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "lib/primitives/tiles.hpp"

namespace powercell {
namespace {

// A tile (of at least so many pairs) needs 2^digit_bits counters. On a CPU a few tiles per core suffice. A
// GPU needs many work-items in flight, so it sorts by smaller digits in more passes.
constexpr std::uint32_t smallest_tile_cpu = 1024, smallest_tile_gpu = 32;
constexpr std::uint32_t tiles_per_core_cpu = 8, tiles_per_core_gpu = 256;

RadixSort::Shape chosen(RadixSort::Shape shape, const DeviceInfo& device) {
  const bool gpu = device.type == DeviceInfo::Type::gpu;
  if (shape.digit_bits == 0) shape.digit_bits = gpu ? 4 : 8;
  if (shape.tiles == 0)
    shape.tiles = std::max(1u, device.compute_units) * (gpu ? tiles_per_core_gpu : tiles_per_core_cpu);
  return shape;
}

std::shared_ptr<const cl::Program> sort_program(cl::Context& context, RadixSort::Shape shape) {
  const unsigned bits = chosen(shape, context.info()).digit_bits;
  return context.program("primitives/radix_sort.cl", {"RADIX_BITS=" + std::to_string(bits)});
}

}  // namespace

RadixSort::RadixSort(const std::shared_ptr<cl::Context>& context, Shape shape)
    : shape_(chosen(shape, context->info())),
      count_(context, sort_program(*context, shape), "count_digits"),
      scatter_(context, sort_program(*context, shape), "scatter_by_digit"),
      scan_(context, ExclusiveScan::Type::uint32),
      keys_(context),
      values_(context),
      counts_(context) {}

void RadixSort::enqueue(cl_mem keys, cl_mem values, std::uint32_t count, unsigned bits) {
  if (count < 2 || bits == 0) return;
  const bool gpu = keys_.context()->info().type == DeviceInfo::Type::gpu;
  const std::uint32_t smallest = gpu ? smallest_tile_gpu : smallest_tile_cpu;
  const auto [tile, tiles] = tiles_of(count, smallest, shape_.tiles);
  const std::uint32_t counters = tiles << shape_.digit_bits;
  keys_.reserve(std::size_t{count} * sizeof(cl_ulong));
  values_.reserve(std::size_t{count} * sizeof(cl_uint));
  counts_.reserve(std::size_t{counters} * sizeof(cl_uint));

  // An even number of passes ends in the caller's buffers. A digit above the keys is 0 and moves nothing.
  unsigned passes = (bits + shape_.digit_bits - 1) / shape_.digit_bits;
  passes += passes % 2;
  cl_mem from_keys = keys, from_values = values, to_keys = keys_.handle(), to_values = values_.handle();
  for (unsigned pass = 0; pass < passes; ++pass) {
    const std::uint32_t shift = pass * shape_.digit_bits;
    count_.args(tiles, tile, count, shift, from_keys, counts_).submit(tiles, shape_.local);
    scan_.enqueue(counts_.handle(), counters, shape_.local);
    scatter_.args(tiles, tile, count, shift, from_keys, from_values, counts_, to_keys, to_values)
        .submit(tiles, shape_.local);
    std::swap(from_keys, to_keys);
    std::swap(from_values, to_values);
  }
}

}  // namespace powercell
