#include "lib/device_diagram/device_diagram.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/layout.h"
#include "lib/cl/choose.hpp"
#include "lib/cl/quirks.hpp"
#include "lib/device_diagram/golden.hpp"
#include "lib/diagram/setup.hpp"
#include "lib/scene/variant.hpp"

namespace powercell {
namespace {

static_assert(SEED_OK == static_cast<int>(SeedStatus::ok) &&
              SEED_OK == static_cast<int>(DeviceSeedStatus::ok));
static_assert(SEED_HIDDEN == static_cast<int>(SeedStatus::hidden) &&
              SEED_HIDDEN == static_cast<int>(DeviceSeedStatus::hidden));
static_assert(SEED_DUPLICATE == static_cast<int>(SeedStatus::duplicate) &&
              SEED_DUPLICATE == static_cast<int>(DeviceSeedStatus::duplicate));
static_assert(SEED_INVALID == static_cast<int>(DeviceSeedStatus::invalid));
static_assert(SEED_UNFINISHED == static_cast<int>(DeviceSeedStatus::unfinished));

Variant variant(const Device& device, const Domain& domain, Precision precision, Capacity capacity) {
  return {domain.dimension(), domain.cell_dimension(), precision == Precision::float32, capacity,
          cl::lane_width(device.context()->settings(), domain.cell_dimension())};
}

/// The defines of kernels that hold no cell.
std::vector<std::string> plain_defines(const Device& device, const Domain& domain, Precision precision) {
  return variant(device, domain, precision, {1, 1}).defines();
}

template <class Real>
void write_frame(const Frame& frame, cl::RawBuffer& to) {
  std::array<Real, FRAME_SIZE> numbers{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Real high = static_cast<Real>(frame.centre[k]);
    numbers[FRAME_CENTRE + k] = high;
    numbers[FRAME_CENTRE_LOW + k] = static_cast<Real>(frame.centre[k] - static_cast<double>(high));
  }
  numbers[FRAME_SCALE] = static_cast<Real>(frame.scale);
  numbers[FRAME_UNIT] = static_cast<Real>(1 / frame.scale);
  to.reserve(sizeof numbers);
  to.write(numbers.data(), sizeof numbers);
}

/// \throw Error unsupported for a group
const Device& single(const Device& device) {
  cl::require_single(device, "a diagram in device memory is computed by");
  return device;
}

}  // namespace

DeviceDiagram::State::State(Device device_in, Domain domain_in, Options options_in)
    : device(std::move(device_in)),
      domain(std::move(domain_in)),
      options(std::move(options_in)),
      precision(choose_precision(single(device), options.precision)),
      room(domain.is_periodic() ? clip_mesh_of(domain) : nullptr),
      domain_buffers(device.context(), room ? *room : domain.mesh(), precision == Precision::float32),
      facets(domain_buffers),
      frame_(device.context()),
      seeds_(device.context(), plain_defines(device, domain, precision), precision == Precision::float32,
             domain.mesh().period.get(), domain_buffers.frame()),
      tree_(device.context(), plain_defines(device, domain, precision)),
      blocks_(device.context(), variant(device, domain, precision, {1, 1}),
              std::make_shared<BlockBuffers>(device.context())),
      pairs_(domain_buffers, plain_defines(device, domain, precision)),
      walls_(device.context(), facets, plain_defines(device, domain, precision), real_bytes()),
      compaction_(device.context()),
      finish_(device.context(),
              device.context()->program("device_diagram/finish.cl", plain_defines(device, domain, precision)),
              "write_measures"),
      piece_status_(device.context()),
      list_(device.context()),
      found_(device.context()),
      for_host_(device.context()),
      moments_(device.context()),
      reach_(device.context()) {
  if (domain.is_solid())
    throw Error(
        ErrorCode::unsupported,
        "a diagram in device memory needs regions, which a solid does not have; give a tetrahedral mesh "
        "of the solid (Domain::volume)");
  if (domain.is_periodic())
    images_.emplace(device.context(), plain_defines(device, domain, precision), *domain.mesh().period,
                    domain_buffers.frame());
  upload_frame();
  clip_ = clip_kernels(false);
  device.context()->finish();  // nobody waits for later results, and so for a failed write of the domain
}

std::vector<cl::Kernel> DeviceDiagram::State::clip_kernels(bool with_density) const {
  const std::vector<Capacity>& all = capacities(domain.cell_dimension());
  std::vector<cl::Kernel> kernels;
  for (std::size_t capacity = 0; capacity < all.size(); ++capacity) {
    const Variant used = variant(device, domain, precision, all[capacity]);
    auto program =
        device.context()->program(with_density ? device_density_file : device_clip_file, used.defines());
    program->trust_after([&] {
      with_density ? require_golden_masses(device, used, capacity)
                   : require_golden_measures(device, used, capacity);
    });
    kernels.emplace_back(device.context(), std::move(program), "clip_pairs");
  }
  return kernels;
}

void DeviceDiagram::State::set_density(cl_mem values) {
  if (values && !density_) {
    clip_density_ = clip_kernels(true);
    density_.emplace(domain_buffers, plain_defines(device, domain, precision));
  }
  if (density_) density_->set(values);
}

void DeviceDiagram::State::upload_frame() {
  const Frame& frame = domain_buffers.frame();
  const auto fits = [](double x) { return std::isnormal(static_cast<float>(x)); };
  if (frame.split && !(fits(frame.scale) && fits(1 / frame.scale) && fits(domain.measure())))
    throw Error(ErrorCode::unsupported,
                "the size or measure of the domain is outside the range of single precision; choose "
                "Precision::float64");
  frame.split ? write_frame<float>(frame, frame_) : write_frame<double>(frame, frame_);
}

TreeBlocks::Tree DeviceDiagram::State::device_tree() const {
  return {points_,
          tree_.node_low.handle(),
          tree_.node_high.handle(),
          tree_.level_offset.handle(),
          points_count_,
          tree_.node_count(),
          tree_.levels()};
}

std::uint64_t DeviceDiagram::State::launch_pairs() const {
  return options.chunk_pairs > 0 ? options.chunk_pairs : device.context()->settings().launch_pairs;
}

DeviceGeometry::Clipped DeviceDiagram::State::clipped(std::uint32_t n) const {
  return {n,
          seeds_,
          pairs_,
          images_ ? &*images_ : nullptr,
          blocks_,
          device_tree(),
          piece_status_.handle(),
          moments_.handle()};
}

void DeviceDiagram::State::clip_with(std::size_t capacity, bool listed, std::uint32_t n) {
  const std::uint64_t most = launch_pairs();
  cl::Kernel& kernel = (density() ? clip_density_ : clip_)[capacity];
  for (std::uint64_t begin = 0; begin < pairs_.capacity; begin += most) {
    const auto first = static_cast<cl_uint>(begin);
    const auto end = static_cast<cl_uint>(std::min<std::uint64_t>(begin + most, pairs_.capacity));
    kernel.args(first, end, n, cl_int{images_.has_value()}, pairs_.offset, cl_int{listed}, list_, found_,
                pairs_.seed, pairs_.region, seeds_.state, domain_buffers.corners,
                domain_buffers.region_offset, domain_buffers.region_vertex, domain_buffers.behind,
                domain_buffers.shape, piece_status_, moments_, reach_);
    walls_.append_store(kernel);
    if (density()) density_->append_arguments(kernel);
    blocks_.append_arguments(kernel, device_tree());
    kernel.submit(end - first);
  }
}

std::uint32_t DeviceDiagram::State::stored_walls(cl_uint faces) const {
  if (wall_capacity > 0) return wall_capacity;
  // More than pieces have on average; a cell in several pieces has a row besides.
  const bool volume = domain.cell_dimension() == 3, whole = domain_buffers.mesh().region_count() == 1;
  const std::uint64_t walls = volume ? (whole ? 20 : 16) : (whole ? 8 : 6);
  // A facet has a part for each piece that meets it: k pieces of a polygon of f edges have f + 2 k, those of
  // a tetrahedron 4 k.
  const std::uint64_t parts = (volume ? 4 : 2) * (whole ? 1 : 2);
  const std::uint64_t each = (faces & FACES_WALLS) != 0 ? walls : parts;
  const std::uint64_t edges = (faces & FACES_BOUNDARY) != 0 ? 2 * domain_buffers.mesh().facet.size() : 0;
  return static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(each * pairs_.capacity + edges, 4096, DeviceWalls::most_entries));
}

void DeviceDiagram::State::clip(std::uint32_t n) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  piece_status_.resize(pairs_.capacity);
  list_.resize(pairs_.capacity);
  found_.resize(1);
  moments_.reserve(std::size_t{pairs_.capacity} * (2 + d) * real_bytes());
  reach_.reserve(images_ ? n * real_bytes() : 0);
  piece_status_.zero();
  if (density()) density_->begin(pairs_.capacity);
  clip_with(first_capacity, false, n);
  for (std::size_t capacity = first_capacity + 1; capacity < clip_.size(); ++capacity) {
    compaction_.enqueue(piece_status_.handle(), pairs_.capacity, PIECE_FULL, list_.handle(), pairs_.capacity,
                        found_.handle());
    clip_with(capacity, true, n);
  }
  if (images_) images_->prove(seeds_, n, reach_.handle(), piece_status_.handle());
}

void DeviceDiagram::State::order_seeds(cl_mem positions, cl_mem weights, std::uint32_t n) {
  seeds_.enqueue(frame_.handle(), positions, weights, n);
  if (images_) images_->enqueue(seeds_, n, image_capacity);
  points_ = images_ ? images_->points.handle() : seeds_.points.handle();
  points_count_ = images_ ? images_->total : n;
}

void DeviceDiagram::State::enqueue(cl_mem positions, cl_mem weights, std::uint32_t n,
                                   const DeviceResults& results, Rooms rooms, cl_event* done) {
  const bool rows = wants_rows(results), list = wants_list(results), cells = wants_cells(results),
             boundary = wants_boundary(results);
  const cl_uint faces = (rows ? FACES_WALLS : 0u) | (boundary ? FACES_BOUNDARY : 0u);
  if (cells && !geometry_)
    geometry_.emplace(domain_buffers, facets, variant(device, domain, precision, {1, 1}), launch_pairs());
  order_seeds(positions, weights, n);
  tree_.enqueue(points_, points_, points_count_);
  blocks_.enqueue(device_tree(), n);
  pairs_.enqueue(seeds_, tree_, n, pair_capacity);
  faces != 0 ? walls_.begin(faces, stored_walls(faces), pairs_.capacity, n, images_ ? &*images_ : nullptr)
             : walls_.begin_without();
  clip(n);
  if (cells) geometry_->count(clipped(n));
  if (faces != 0) walls_.gather(seeds_, pairs_, piece_status_.handle(), n, results.adjacency);
  for_host_.resize(n);
  finish_
      .args(n, seeds_.order, seeds_.state, pairs_.offset, cl_ulong{pairs_.capacity}, piece_status_, moments_,
            frame_, positions, results.measures, results.status, for_host_)
      .submit(n, 0, density() || faces != 0 || list || cells ? nullptr : done);
  if (density())
    density_->write(seeds_, pairs_, results.status, frame_.handle(), positions, n, results.measures,
                    faces != 0 || list || cells ? nullptr : done);
  if (list)
    compaction_.enqueue(for_host_.handle(), n, 1, results.uncertain.seeds, rooms.uncertain,
                        results.uncertain.count, 0, faces != 0 || cells ? nullptr : done);
  if (rows)
    walls_.write(seeds_, results.status, frame_.handle(), n, results.adjacency, rooms.rows,
                 boundary || cells ? nullptr : done);
  if (boundary)
    walls_.write_facets(results.status, frame_.handle(), n, results.boundary_walls, rooms.boundary,
                        cells ? nullptr : done);
  if (cells)
    geometry_->write(clipped(n), results.status, frame_.handle(), positions, results.cells, rooms.cells);
  if (cells && done)
    cl::check(cl::clEnqueueMarkerWithWaitList(device.context()->queue(), 0, nullptr, done),
              "enqueueing a marker");
}

}  // namespace powercell
