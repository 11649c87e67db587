#include "lib/periodic/device_images.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <powercell/error.hpp>
#include <powercell/seeds.hpp>
#include <string>
#include <vector>

#include "kernels/layout.h"
#include "lib/primitives/tiles.hpp"

namespace powercell {
namespace {

// Weights are reduced in tiles of at least 64 seeds; one work-item reduces those of all tiles.
constexpr std::uint32_t most_weight_tiles = 1024, smallest_weight_tile = 64;
constexpr std::size_t numbers_of_tile = 3;
constexpr unsigned curve_bits = 64;

struct ShiftTables {
  std::vector<std::int32_t> number = std::vector<std::int32_t>(SHIFT_COUNT);
  std::vector<std::int32_t> given;  // 3 each
};

/// Numbers the shifts of images in the order that they have in the vectors as given.
ShiftTables shift_tables(const Period& period) {
  struct Entry {
    std::array<std::int64_t, 3> given;
    std::size_t place;
    bool operator<(const Entry& other) const { return given < other.given; }
  };
  std::vector<Entry> entries;
  Shift s;
  for (s[0] = -SHIFT_MOST; s[0] <= SHIFT_MOST; ++s[0])
    for (s[1] = -SHIFT_MOST; s[1] <= SHIFT_MOST; ++s[1])
      for (s[2] = -SHIFT_MOST; s[2] <= SHIFT_MOST; ++s[2]) {
        Shift used{};
        std::copy_n(s.begin(), period.count(), used.begin());
        entries.push_back({period.as_given(used), entries.size()});
      }
  std::stable_sort(entries.begin(), entries.end());
  ShiftTables tables;
  for (std::size_t k = 0; k < entries.size(); ++k) {
    tables.number[entries[k].place] = static_cast<std::int32_t>(k) - SHIFT_COUNT / 2;
    for (const std::int64_t x : entries[k].given) tables.given.push_back(static_cast<std::int32_t>(x));
  }
  return tables;
}

template <class Real>
void write_reals(const std::vector<double>& values, cl::RawBuffer& to) {
  const std::vector<Real> reals(values.begin(), values.end());
  to.reserve(reals.size() * sizeof(Real));
  to.write(reals.data(), reals.size() * sizeof(Real));
}

void write_reals(bool float32, const std::vector<double>& values, cl::RawBuffer& to) {
  float32 ? write_reals<float>(values, to) : write_reals<double>(values, to);
}

std::vector<double> extent_in(const Frame& frame, const Period& period) {
  std::vector<double> extent(EXTENT_SIZE);
  for (int k = 0; k < period.count(); ++k) {
    extent[static_cast<std::size_t>(EXTENT_SPACING + k)] = period.spacing(k) * frame.scale;
    extent[static_cast<std::size_t>(EXTENT_REACH + k)] = period.reach(k);
    if (!(period.reach(k) < SHIFT_MOST - 0.5))  // images are at most that beyond fractions from 0 to 1
      throw Error(ErrorCode::internal, "images in a reduced basis are farther than any should be");
  }
  extent[EXTENT_MEASURE] = period.measure() * std::pow(frame.scale, period.dimension());
  return extent;
}

/// The grid of the curve over the room around all cells, which has size 1 in the frame: low corner, cells per
/// unit of length. Images farther along bounded axes are at its border.
std::vector<double> grid_in(const Frame& frame, const Period& period) {
  std::vector<double> grid(4);
  for (int c = 0; c < period.dimension(); ++c)
    grid[static_cast<std::size_t>(c)] = frame.to_device(period.room_low()[static_cast<std::size_t>(c)], c);
  grid[3] = std::ldexp(1.0, period.dimension() == 2 ? 31 : 21);
  return grid;
}

}  // namespace

DeviceImages::DeviceImages(const std::shared_ptr<cl::Context>& context,
                           const std::vector<std::string>& defines, const Period& period, const Frame& frame)
    : points(context),
      image_seed(context),
      image_shift(context),
      shift_given(context),
      weights_(context, context->program("periodic/margin.cl", defines), "weights_of_tiles"),
      margin_kernel_(context, context->program("periodic/margin.cl", defines), "find_margin"),
      count_(context, context->program("periodic/images.cl", defines), "count_images"),
      list_(context, context->program("periodic/images.cl", defines), "list_images"),
      mark_(context, context->program("periodic/images.cl", defines), "mark_images"),
      keys_kernel_(context, context->program("seeds/order.cl", defines), "make_keys"),
      place_(context, context->program("periodic/images.cl", defines), "place_images"),
      prove_(context, context->program("periodic/prove.cl", defines), "prove_reach"),
      scan_(context, ExclusiveScan::Type::uint64),
      sort_(context),
      extent_(context),
      grid_(context),
      of_tile_(context),
      margin_(context),
      images_(context),
      shift_number_(context),
      number_(context),
      offset_(context),
      keys_(context),
      order_(context),
      status_(context),
      seed_(context) {
  write_reals(frame.split, extent_in(frame, period), extent_);
  write_reals(frame.split, grid_in(frame, period), grid_);
  const ShiftTables tables = shift_tables(period);
  shift_number_.upload(tables.number);
  shift_given.upload(tables.given);
  margin_.reserve(MARGIN_SIZE * sizeof(double));
}

void DeviceImages::find_margin(const DeviceSeeds& seeds, std::uint32_t count) {
  const Tiles tiles = tiles_of(count, smallest_weight_tile, most_weight_tiles);
  of_tile_.reserve(std::size_t{tiles.count} * numbers_of_tile * sizeof(double));
  weights_.args(tiles.count, tiles.size, count, seeds.points, seeds.state, of_tile_).submit(tiles.count);
  margin_kernel_.args(tiles.count, of_tile_, extent_, margin_).submit(1);
}

std::uint32_t DeviceImages::read_number(std::uint32_t count) const {
  std::uint64_t number = 0;
  offset_.download(std::span(&number, 1), count);
  if (number > most_seeds_of_diagram - count)
    throw Error(ErrorCode::out_of_device_memory,
                std::to_string(count) + " seeds have " + std::to_string(number) +
                    " images in the periodic domain, more than one diagram can have; use fewer seeds");
  return static_cast<std::uint32_t>(number);
}

void DeviceImages::list(const DeviceSeeds& seeds, std::uint32_t count) {
  order_.resize(room_);
  status_.resize(room_);
  seed_.resize(room_);
  number_.resize(room_);
  keys_.resize(room_);
  image_seed.resize(room_);
  image_shift.resize(room_);
  images_.reserve(std::size_t{room_} * Frame::point_bytes);
  points.reserve(std::size_t{total} * Frame::point_bytes);
  if (room_ > 0) {
    list_
        .args(count, room_, seeds.order, seeds.state, seeds.points, seeds.wrap->place, seeds.wrap->period,
              extent_, margin_, shift_number_, offset_, images_, seed_, number_)
        .submit(count);
    mark_.args(room_, count, offset_, order_, status_, images_).submit(room_);
    keys_kernel_.args(room_, cl_int{KEY_COARSE}, order_, images_, status_, grid_, keys_).submit(room_);
    sort_.enqueue(keys_.handle(), order_.handle(), room_, curve_bits);
  }
  place_.args(total, count, seeds.points, order_, images_, seed_, number_, points, image_seed, image_shift)
      .submit(total);
}

void DeviceImages::enqueue(const DeviceSeeds& seeds, std::uint32_t count, std::uint32_t most) {
  find_margin(seeds, count);
  offset_.resize(std::size_t{count} + 1);
  count_
      .args(count, seeds.order, seeds.state, seeds.wrap->place, seeds.wrap->period, extent_, margin_, offset_)
      .submit(std::size_t{count} + 1);
  scan_.enqueue(offset_.handle(), count + 1);
  room_ = most == 0 ? read_number(count)
                    : std::min(most, static_cast<std::uint32_t>(most_seeds_of_diagram - count));
  total = count + room_;
  list(seeds, count);
}

void DeviceImages::prove(const DeviceSeeds& seeds, std::uint32_t count, cl_mem reach, cl_mem status) {
  prove_
      .args(count, room_, offset_, seeds.order, seeds.points, seeds.wrap->place, seeds.wrap->period, extent_,
            margin_, reach, status)
      .submit(count);
}

}  // namespace powercell
