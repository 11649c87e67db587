#include "lib/seeds/device_seeds.hpp"

#include <cmath>

#include "kernels/layout.h"
#include "lib/domain/frame.hpp"
#include "lib/primitives/tiles.hpp"

namespace powercell {

namespace {

// The bounding box is reduced in tiles of at least 64 seeds; one work-item reduces the boxes of all tiles, so
// there are at most 1024.
constexpr std::uint32_t most_box_tiles = 1024, smallest_box_tile = 64;

}  // namespace

DeviceSeeds::DeviceSeeds(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
                         bool float32, const Period* period, const Frame& host_frame)
    : points(context),
      order(context),
      state(context),
      float32_(float32),
      pack_(context, context->program("seeds/pack.cl", defines), "pack_seeds"),
      box_(context, context->program("seeds/pack.cl", defines), "box_of_tiles"),
      grid_(context, context->program("seeds/order.cl", defines), "make_grid"),
      number_(context, context->program("seeds/order.cl", defines), "number_seeds"),
      keys_kernel_(context, context->program("seeds/order.cl", defines), "make_keys"),
      place_(context, context->program("seeds/order.cl", defines), "place_seeds"),
      sort_(context),
      packed_(context),
      boxes_(context),
      grid_box_(context),
      keys_(context),
      status_(context) {
  if (period) wrap.emplace(context, defines, *period, host_frame);
}

void DeviceSeeds::find_box(std::uint32_t count) {
  const Tiles tiles = tiles_of(count, smallest_box_tile, most_box_tiles);
  boxes_.reserve(std::size_t{tiles.count} * 6 * sizeof(double));
  grid_box_.reserve(4 * sizeof(double));
  box_.args(tiles.count, tiles.size, count, packed_, status_, boxes_).submit(tiles.count);
  grid_.args(tiles.count, boxes_, grid_box_).submit(1);
}

void DeviceSeeds::sort_by(int kind, std::uint32_t count, unsigned bits) {
  keys_kernel_.args(count, static_cast<cl_int>(kind), order, packed_, status_, grid_box_, keys_)
      .submit(count);
  sort_.enqueue(keys_.handle(), order.handle(), count, bits);
}

void DeviceSeeds::pack(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count) {
  if (wrap) {
    wrap->enqueue(frame, positions, weights, count, packed_.handle(), status_.handle());
    return;
  }
  pack_
      .args(count, frame, positions, weights ? weights : positions, cl_int{weights != nullptr}, packed_,
            status_)
      .submit(count);
}

void DeviceSeeds::enqueue(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count) {
  packed_.reserve(count * Frame::point_bytes);
  points.reserve(count * Frame::point_bytes);
  keys_.reserve(count * sizeof(cl_ulong));
  status_.resize(count);
  state.resize(count);
  order.resize(count);
  pack(frame, positions, weights, count);
  find_box(count);
  number_.args(count, order).submit(count);
  // From the least significant key to the most; each sort is stable.
  if (weights) sort_by(KEY_WEIGHT, count, float32_ ? 32 : 64);
  sort_by(KEY_HASH, count, 32);
  sort_by(KEY_FINE, count, 63);
  sort_by(KEY_COARSE, count, 64);
  place_
      .args(count, order, packed_, status_, positions, weights ? weights : positions,
            cl_int{weights != nullptr}, cl_int{wrap.has_value()}, wrap ? wrap->place.handle() : positions,
            points, state)
      .submit(count);
}

namespace {

/// The numbers of the lattice with those of the frame.
PeriodGrid::Numbers numbers_in(const Frame& frame, const Period& period) {
  PeriodGrid::Numbers numbers = period.grid().numbers();
  for (std::size_t c = 0; c < 3; ++c) {
    if (numbers[PERIOD_ROUNDED + c] == 0) continue;
    const auto quantum = static_cast<int>(numbers[PERIOD_QUANTUM + c]);
    // The corners of the room around all cells are multiples of the quantum, so its centre is one of the
    // half.
    numbers[PERIOD_CENTRE + c] = static_cast<std::int64_t>(std::ldexp(frame.centre[c], 1 - quantum));
    numbers[PERIOD_UNIT + c] = quantum - 1 + std::ilogb(frame.scale);
  }
  return numbers;
}

}  // namespace

DeviceWrap::DeviceWrap(const std::shared_ptr<cl::Context>& context, const std::vector<std::string>& defines,
                       const Period& lattice, const Frame& host_frame)
    : period(context),
      place(context),
      shift(context),
      dimension_(static_cast<std::size_t>(lattice.dimension())),
      wrap_(context, context->program("seeds/wrap.cl", defines), "wrap_seeds") {
  period.upload(numbers_in(host_frame, lattice));
}

void DeviceWrap::enqueue(cl_mem frame, cl_mem positions, cl_mem weights, std::uint32_t count, cl_mem packed,
                         cl_mem status) {
  place.resize(count * dimension_);
  shift.resize(std::size_t{count} * 3);
  wrap_
      .args(count, frame, positions, weights ? weights : positions, cl_int{weights != nullptr}, period,
            packed, status, place, shift)
      .submit(count);
}

}  // namespace powercell
