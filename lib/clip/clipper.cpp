#include "lib/clip/clipper.hpp"

#include <algorithm>
#include <numeric>

#include "kernels/layout.h"
#include "lib/cl/quirks.hpp"
#include "lib/clip/golden.hpp"
#include "lib/report/log.hpp"

namespace powercell {

namespace {

/// Maximum size of the output rows in device memory, in bytes.
constexpr std::size_t row_budget = std::size_t{192} << 20;
/// Moments of up to so many pairs are read with the statuses; those of more only where they cannot be mapped.
constexpr std::size_t few_pairs = 1024;
/// In passes of up to so many pairs only the first capacity is used.
constexpr std::uint64_t one_capacity_pairs = 5000;

}  // namespace

void ClipStatistics::add(const ClipStatistics& other) {
  retried += other.retried;
  on_host += other.on_host;
  uncertain += other.uncertain;
  rounds = std::max(rounds, other.rounds);
}

ClipMemory::ClipMemory(const std::shared_ptr<cl::Context>& context)
    : active(context),
      seed(context),
      region(context),
      status(context),
      faces(context),
      vertices(context),
      link(context),
      border(context),
      moments(context),
      wall(context),
      vertex(context),
      reach(context) {}

std::size_t ClipMemory::bytes() const {
  std::size_t sum =
      border.size() * sizeof(std::int32_t) + moments.bytes() + wall.bytes() + vertex.bytes() + reach.bytes();
  for (const cl::Buffer<std::uint32_t>* buffer : {&active, &seed, &region, &status, &faces, &vertices, &link})
    sum += buffer->size() * sizeof(std::uint32_t);
  return sum;
}

Clipper::Clipper(const Scene& scene, Candidates& candidates, int outputs, ClipOptions options,
                 std::optional<ClipMemory> memory)
    : scene_(scene),
      candidates_(candidates),
      outputs_(outputs | candidates.outputs()),
      options_(options),
      memory_(memory ? std::move(*memory) : ClipMemory(scene.context())) {}

bool Clipper::wants_rows() const {
  return (outputs_ & (OUTPUT_WALLS | OUTPUT_GEOMETRY)) != 0;
}

const Capacity& Clipper::capacity(std::size_t number) const {
  return capacities(scene_.mesh().cell_dimension)[number];
}

cl::Kernel& Clipper::kernel(std::size_t number) {
  const auto found = kernels_.find(number);
  if (found != kernels_.end()) return found->second;
  const RegionMesh& mesh = scene_.mesh();
  const Variant variant{mesh.dimension, mesh.cell_dimension, scene_.float32(), capacity(number),
                        cl::lane_width(scene_.context()->settings(), mesh.cell_dimension)};
  auto program = scene_.context()->program(candidates_.file(), variant.defines());
  program->trust_after([&] { golden_test(scene_.context(), candidates_, variant, number); });
  return kernels_
      .emplace(number, cl::Kernel(scene_.context(), std::move(program), std::string(candidates_.kernel())))
      .first->second;
}

std::size_t Clipper::rows_that_fit(std::size_t number) const {
  if (!wants_rows()) return std::size_t{1} << 30;
  const auto [vertices, faces] = capacity(number);
  std::size_t bytes = static_cast<std::size_t>(faces) * 12;
  if (outputs_ & OUTPUT_GEOMETRY)
    bytes += static_cast<std::size_t>(vertices * (scene_.mesh().dimension * 8 + 24));
  return std::max<std::size_t>(1, row_budget / bytes);
}

void Clipper::reserve_rows(std::size_t rows, const Capacity& capacity) {
  const RegionMesh& mesh = scene_.mesh();
  const bool geometry = (outputs_ & OUTPUT_GEOMETRY) != 0;
  const std::size_t real = scene_.float32() ? sizeof(float) : sizeof(double);
  const std::size_t faces = wants_rows() ? rows * static_cast<std::size_t>(capacity.faces) : 0;
  const std::size_t vertices = geometry ? rows * static_cast<std::size_t>(capacity.vertices) : 0;
  memory_.faces.resize(wants_rows() ? rows + 1 : 0);
  memory_.border.resize(faces);
  memory_.wall.reserve(faces * real);
  memory_.vertices.resize(geometry ? rows + 1 : 0);
  memory_.vertex.reserve(vertices * static_cast<std::size_t>(mesh.dimension) * real);
  memory_.link.resize(mesh.cell_dimension == 3 ? vertices * 6 : 0);
  memory_.reach.reserve((outputs_ & OUTPUT_REACH) != 0 ? rows * real : 0);
  memory_.faces.zero();
  memory_.vertices.zero();
}

void Clipper::read_rows(const Capacity& capacity, PieceBatch& batch) {
  if (!reader_) reader_.emplace(scene_.context());
  const auto stride = static_cast<std::size_t>(capacity.faces);
  const bool walls_alone = (outputs_ & (OUTPUT_WALLS | OUTPUT_GEOMETRY)) == OUTPUT_WALLS;
  reader_->read_counts(memory_.faces, stride, batch.face_offset, walls_alone && !scene_.float32());
  if (reader_->maps()) {
    batch.mapped_border = reader_->map<std::int32_t>(memory_.border.raw());
    batch.mapped_wall = reader_->map<double>(memory_.wall);
    batch.stride = stride;
    return;
  }
  reader_->read(memory_.border, 1, batch.border);
  if (outputs_ & OUTPUT_WALLS) reader_->read_reals(memory_.wall, scene_.float32(), 1, batch.wall);
  if (!(outputs_ & OUTPUT_GEOMETRY)) return;
  reader_->read_counts(memory_.vertices, static_cast<std::size_t>(capacity.vertices), batch.vertex_offset,
                       false);
  reader_->read_reals(memory_.vertex, scene_.float32(), static_cast<std::size_t>(scene_.mesh().dimension),
                      batch.vertex);
  if (scene_.mesh().cell_dimension == 3) reader_->read(memory_.link, 6, batch.link);
}

void Clipper::unmap_rows() {
  if (!reader_) return;
  for (std::size_t k = 0; k < memory_.pieces.used; ++k) memory_.pieces.batches[k].copy_mapped();
  reader_->unmap();
}

void Clipper::launch(std::size_t number, std::span<const std::uint32_t> active, int round, Outcome& outcome) {
  const std::size_t rows = active.size();
  launch_ranks_.resize(rows);
  std::transform(active.begin(), active.end(), launch_ranks_.begin(),
                 [&](std::uint32_t pair) { return pair_seed_[pair]; });
  candidates_.prepare(launch_ranks_, round);
  unmap_rows();
  memory_.active.upload(active);
  memory_.status.resize(rows);
  reserve_rows(rows, capacity(number));

  const DomainBuffers& domain = scene_.domain;
  cl::Kernel& call = kernel(number);
  call.args(static_cast<cl_uint>(rows), static_cast<cl_uint>(outputs_), memory_.active, memory_.seed,
            memory_.region, domain.corners, domain.region_offset, domain.region_vertex, domain.behind,
            domain.shape, memory_.status, memory_.moments, memory_.faces, memory_.border, memory_.wall,
            memory_.vertices, memory_.vertex, memory_.link, memory_.reach);
  candidates_.append_arguments(call);
  call.launch_in_parts(rows);

  const std::size_t first_uncertain = outcome.uncertain.size();
  read_launch(rows, capacity(number));
  sort_statuses(active, outcome);
  if (outputs_ & OUTPUT_REACH) read_reach(active);
  PieceBatch& rows_of_launch = memory_.pieces.add_batch();
  rows_of_launch.mapped_border = nullptr;
  rows_of_launch.repeats = false;
  if (!wants_rows()) return;
  read_rows(capacity(number), rows_of_launch);
  if (options_.exact) return;  // the host's rows replace those of uncertain pieces
  rows_of_launch.repeats = std::any_of(
      outcome.uncertain.begin() + static_cast<std::ptrdiff_t>(first_uncertain), outcome.uncertain.end(),
      [&](std::uint32_t pair) { return rows_of_launch.row_repeats(memory_.pieces.row[pair]); });
}

void Clipper::read_launch(std::size_t rows, const Capacity& capacity) {
  launch_status_.resize(rows);
  const std::size_t real = scene_.float32() ? sizeof(float) : sizeof(double);
  cl::Reads reads(scene_.context());
  reads.add(memory_.status.raw(), launch_status_.data(), rows * sizeof launch_status_[0]);
  if ((outputs_ & (OUTPUT_WALLS | OUTPUT_GEOMETRY)) == OUTPUT_WALLS) {
    if (!reader_) reader_.emplace(scene_.context());
    reader_->read_ahead(reads, memory_.faces, static_cast<std::size_t>(capacity.faces), memory_.border,
                        memory_.wall, real);
  }
  const bool maps = scene_.context()->info().type == DeviceInfo::Type::cpu;
  moments_read_ = rows == pair_seed_.size() && (rows <= few_pairs || !maps);
  moments_changed_ = false;
  if (moments_read_) {
    host_moments_.resize(rows * (2 + static_cast<std::size_t>(scene_.mesh().dimension)) * real);
    reads.add(memory_.moments, host_moments_.data(), host_moments_.size());
  }
  reads.wait();
}

void Clipper::sort_statuses(std::span<const std::uint32_t> active, Outcome& outcome) {
  PieceSet& pieces = memory_.pieces;
  const std::size_t rows = active.size();
  const auto batch = static_cast<std::uint32_t>(pieces.used);
  std::uint32_t worst = PIECE_DONE;
  for (std::size_t row = 0; row < rows; ++row) {
    pieces.status[active[row]] = launch_status_[row];
    pieces.batch[active[row]] = batch;
    pieces.row[active[row]] = static_cast<std::uint32_t>(row);
    worst = std::max(worst, launch_status_[row]);
  }
  if (worst <= PIECE_FLAT) return;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::uint32_t pair = active[row], status = launch_status_[row] & ~std::uint32_t{PIECE_UNCERTAIN};
    if (launch_status_[row] & PIECE_UNCERTAIN) outcome.uncertain.push_back(pair);
    pieces.status[pair] = status;
    if (status == PIECE_MORE) outcome.more.push_back(pair);
    if (status == PIECE_FULL) outcome.full.push_back(pair);
    if (status == PIECE_TANGLED) outcome.tangled.push_back(pair);
  }
}

void Clipper::read_reach(std::span<const std::uint32_t> active) {
  const auto store = [&](auto rows) {
    memory_.reach.read(rows.data(), rows.size() * sizeof rows[0]);
    for (std::size_t row = 0; row < rows.size(); ++row)
      memory_.pieces.reach[active[row]] = static_cast<double>(rows[row]);
  };
  if (scene_.float32())
    store(std::vector<float>(active.size()));
  else
    store(std::vector<double>(active.size()));
}

void Clipper::run(std::size_t number, const List& active, Outcome& outcome) {
  List pending = active;
  for (int round = 0; !pending.empty(); ++round) {
    outcome.more.clear();
    const std::size_t most = std::min(candidates_.most_pairs(round), rows_that_fit(number));
    for (std::size_t begin = 0; begin < pending.size(); begin += most) {
      const std::size_t count = std::min(most, pending.size() - begin);
      launch(number, std::span(pending).subspan(begin, count), round, outcome);
    }
    statistics_.rounds = std::max(statistics_.rounds, round + 1);
    pending = outcome.more;
  }
}

void Clipper::read_moments() {
  const std::size_t real = scene_.float32() ? sizeof(float) : sizeof(double);
  host_moments_.resize(pair_seed_.size() * (2 + static_cast<std::size_t>(scene_.mesh().dimension)) * real);
  memory_.moments.read(host_moments_.data(), host_moments_.size());
  moments_read_ = true;
}

ClipMemory Clipper::release() && {
  memory_.pieces.used = 0;
  unmap_rows();
  return std::move(memory_);
}

Clipper::List Clipper::begin_chunk(std::span<const std::uint32_t> pair_seed,
                                   std::span<const std::uint32_t> pair_region) {
  moments_read_ = moments_changed_ = false;
  memory_.pieces.used = 0;
  memory_.pieces.tied.clear();
  unmap_rows();
  pair_seed_ = pair_seed;
  pair_region_ = pair_region;
  const std::size_t count = pair_seed.size();
  const std::size_t real = scene_.float32() ? sizeof(float) : sizeof(double);
  memory_.seed.upload(pair_seed);
  memory_.region.upload(pair_region);
  memory_.moments.reserve(count * (2 + static_cast<std::size_t>(scene_.mesh().dimension)) * real);
  memory_.pieces.status.resize(count);
  memory_.pieces.batch.resize(count);
  memory_.pieces.row.resize(count);
  memory_.pieces.reach.resize((outputs_ & OUTPUT_REACH) != 0 ? count : 0);
  List pending(count);
  std::iota(pending.begin(), pending.end(), 0U);
  return pending;
}

const PieceSet& Clipper::clip_with(std::size_t number, std::span<const std::uint32_t> pair_seed,
                                   std::span<const std::uint32_t> pair_region) {
  Outcome outcome;
  run(number, begin_chunk(pair_seed, pair_region), outcome);
  return memory_.pieces;
}

const PieceSet& Clipper::clip(std::span<const std::uint32_t> pair_seed,
                              std::span<const std::uint32_t> pair_region) {
  return finish_on_host(clip_on_device(pair_seed, pair_region));
}

std::vector<std::uint32_t> Clipper::clip_on_device(std::span<const std::uint32_t> pair_seed,
                                                   std::span<const std::uint32_t> pair_region) {
  List pending = begin_chunk(pair_seed, pair_region), for_host;
  const std::size_t numbers =
      options_.pairs <= one_capacity_pairs ? 1 : capacities(scene_.mesh().cell_dimension).size();
  for (std::size_t number = 0; number < numbers && !pending.empty(); ++number) {
    if (number > 0) {
      statistics_.retried += pending.size();
      write_log(LogLevel::detail, [&] {
        return "clipping " + std::to_string(pending.size()) + " pieces again with a capacity of " +
               std::to_string(capacity(number).vertices) + " vertices";
      });
    }
    Outcome outcome;
    run(number, pending, outcome);
    for_host.insert(for_host.end(), outcome.tangled.begin(), outcome.tangled.end());
    statistics_.uncertain += outcome.uncertain.size();
    if (options_.exact) for_host.insert(for_host.end(), outcome.uncertain.begin(), outcome.uncertain.end());
    pending = std::move(outcome.full);
    std::sort(pending.begin(), pending.end());
  }
  for_host.insert(for_host.end(), pending.begin(), pending.end());
  std::sort(for_host.begin(), for_host.end());
  if (options_.read_moments && !moments_read_) read_moments();
  return for_host;
}

}  // namespace powercell
