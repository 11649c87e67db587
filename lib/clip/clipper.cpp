#include "lib/clip/clipper.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <type_traits>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"
#include "lib/clip/golden.hpp"
#include "lib/report/log.hpp"

namespace powercell {

namespace {

/// Bytes of output rows in device memory at once.
constexpr std::size_t row_budget = std::size_t{192} << 20;

/// Pairs that a thread of the host takes at once.
constexpr std::size_t pairs_of_task = 64;

/// Arguments that all clip kernels share come first; those of the candidates follow.
constexpr unsigned common_arguments = 17;

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
      vertex(context) {}

std::size_t ClipMemory::bytes() const {
  std::size_t sum = border.size() * sizeof(std::int32_t) + moments.bytes() + wall.bytes() + vertex.bytes();
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

cl::Kernel& Clipper::kernel(std::size_t rung) {
  const auto found = kernels_.find(rung);
  if (found != kernels_.end()) return found->second;
  const RegionMesh& mesh = scene_.mesh();
  const Variant variant{mesh.dimension, mesh.cell_dimension, scene_.float32(),
                        capacities(mesh.cell_dimension)[rung], outputs_};
  auto program = scene_.context()->program(candidates_.file(), variant.defines());
  program->trust_after([&] { golden_test(scene_.context(), candidates_, variant, rung); });
  return kernels_
      .emplace(rung, cl::Kernel(scene_.context(), std::move(program), std::string(candidates_.kernel())))
      .first->second;
}

std::size_t Clipper::rows_that_fit(std::size_t rung) const {
  if (!wants_rows()) return std::size_t{1} << 30;
  const RegionMesh& mesh = scene_.mesh();
  const Capacity capacity = capacities(mesh.cell_dimension)[rung];
  std::size_t bytes = static_cast<std::size_t>(capacity.faces) * 12;
  if (outputs_ & OUTPUT_GEOMETRY)
    bytes += static_cast<std::size_t>(capacity.vertices * (mesh.dimension * 8 + 24));
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
  memory_.faces.zero();
  memory_.vertices.zero();
}

void Clipper::read_rows(const Capacity& capacity, PieceBatch& batch) {
  if (!reader_) reader_.emplace(scene_.context());
  const auto room = static_cast<std::size_t>(capacity.faces);
  const bool walls_alone = (outputs_ & (OUTPUT_WALLS | OUTPUT_GEOMETRY)) == OUTPUT_WALLS;
  reader_->begin(memory_.faces, room, batch.face_offset, walls_alone && !scene_.float32());
  if (reader_->lends()) {
    batch.lent_border = reader_->lend<std::int32_t>(memory_.border.raw());
    batch.lent_wall = reader_->lend<double>(memory_.wall);
    batch.room = room;
    return;
  }
  reader_->read(memory_.border, 1, batch.border);
  if (outputs_ & OUTPUT_WALLS) reader_->read_reals(memory_.wall, scene_.float32(), 1, batch.wall);
  if (!(outputs_ & OUTPUT_GEOMETRY)) return;
  reader_->begin(memory_.vertices, static_cast<std::size_t>(capacity.vertices), batch.vertex_offset, false);
  reader_->read_reals(memory_.vertex, scene_.float32(), static_cast<std::size_t>(scene_.mesh().dimension),
                      batch.vertex);
  if (scene_.mesh().cell_dimension == 3) reader_->read(memory_.link, 6, batch.link);
}

void Clipper::take_back_rows() {
  if (!reader_) return;
  for (std::size_t k = 0; k < memory_.pieces.used; ++k) memory_.pieces.batches[k].keep();
  reader_->take_back();
}

void Clipper::launch(std::size_t rung, std::span<const std::uint32_t> active, int round, Outcome& outcome) {
  const Capacity capacity = capacities(scene_.mesh().cell_dimension)[rung];
  const std::size_t rows = active.size();
  launch_ranks_.resize(rows);
  std::transform(active.begin(), active.end(), launch_ranks_.begin(),
                 [&](std::uint32_t pair) { return pair_seed_[pair]; });
  candidates_.prepare(launch_ranks_, round);
  take_back_rows();
  memory_.active.upload(active);
  memory_.status.resize(rows);
  reserve_rows(rows, capacity);

  cl::Kernel& call = kernel(rung);
  call.args(static_cast<cl_uint>(rows), memory_.active, memory_.seed, memory_.region, scene_.corners,
            scene_.region_offset, scene_.region_vertex, scene_.behind, scene_.shape, memory_.status,
            memory_.moments, memory_.faces, memory_.border, memory_.wall, memory_.vertices, memory_.vertex,
            memory_.link);
  candidates_.set_arguments(call, common_arguments);
  call.launch(rows);

  launch_status_.resize(rows);
  memory_.status.download(std::span(launch_status_));
  const auto batch = static_cast<std::uint32_t>(memory_.pieces.used);
  const std::size_t first_uncertain = outcome.uncertain.size();
  std::uint32_t worst = PIECE_WHOLE;
  for (std::size_t row = 0; row < rows; ++row) {
    memory_.pieces.status[active[row]] = launch_status_[row];
    memory_.pieces.batch[active[row]] = batch;
    memory_.pieces.row[active[row]] = static_cast<std::uint32_t>(row);
    worst = std::max(worst, launch_status_[row]);
  }
  if (worst > PIECE_FLAT)
    for (std::size_t row = 0; row < rows; ++row) {
      if (launch_status_[row] & PIECE_UNCERTAIN) outcome.uncertain.push_back(active[row]);
      memory_.pieces.status[active[row]] = launch_status_[row] &= ~std::uint32_t{PIECE_UNCERTAIN};
      if (launch_status_[row] == PIECE_MORE) outcome.more.push_back(active[row]);
      if (launch_status_[row] == PIECE_FULL) outcome.full.push_back(active[row]);
      if (launch_status_[row] == PIECE_TANGLED) outcome.tangled.push_back(active[row]);
    }
  PieceBatch& rows_of_launch = memory_.pieces.add_batch();
  rows_of_launch.lent_border = nullptr;
  rows_of_launch.repeats = false;
  if (!wants_rows()) return;
  read_rows(capacity, rows_of_launch);
  if (options_.exact) return;  // rows of uncertain pieces give way to the host's
  rows_of_launch.repeats = std::any_of(
      outcome.uncertain.begin() + static_cast<std::ptrdiff_t>(first_uncertain), outcome.uncertain.end(),
      [&](std::uint32_t pair) { return rows_of_launch.row_repeats(memory_.pieces.row[pair]); });
}

void Clipper::run_rung(std::size_t rung, const List& active, Outcome& outcome) {
  List pending = active;
  for (int round = 0; !pending.empty(); ++round) {
    outcome.more.clear();
    const std::size_t most = std::min(candidates_.most_pairs(round), rows_that_fit(rung));
    for (std::size_t begin = 0; begin < pending.size(); begin += most) {
      const std::size_t count = std::min(most, pending.size() - begin);
      launch(rung, std::span(pending).subspan(begin, count), round, outcome);
    }
    statistics_.rounds = std::max(statistics_.rounds, round + 1);
    pending = outcome.more;
  }
}

ClipMemory Clipper::release() && {
  memory_.pieces.used = 0;
  take_back_rows();
  return std::move(memory_);
}

void Clipper::write_moments(const List& pairs, std::span<const double> moments) {
  const std::size_t count = 2 + static_cast<std::size_t>(scene_.mesh().dimension);
  const std::size_t first = pairs.front(), rows = pairs.back() + 1 - first;
  const auto patch = [&](auto& all) {
    using Real = typename std::remove_reference_t<decltype(all)>::value_type;
    memory_.moments.read(all.data(), all.size() * sizeof(Real), first * count * sizeof(Real));
    // A measure above 0 says that there is a cell. In single precision, where devices may take numbers below
    // 2^-126 for 0, it stays above 0, and so do the moments that go with it.
    constexpr double least = std::is_same_v<Real, float> ? 0x1p-100 : std::numeric_limits<double>::min();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const double measure = moments[k * count],
                   factor = measure > 0 && measure < least ? least / measure : 1;
      for (std::size_t m = 0; m < count; ++m)
        all[(pairs[k] - first) * count + m] = static_cast<Real>(factor * moments[k * count + m]);
    }
    memory_.moments.write(all.data(), all.size() * sizeof(Real), first * count * sizeof(Real));
  };
  if (scene_.float32()) {
    std::vector<float> all(rows * count);
    patch(all);
  } else {
    std::vector<double> all(rows * count);
    patch(all);
  }
}

int Clipper::clip_on_host(HostClipper& host, std::uint32_t pair, std::span<double> moments,
                          PieceBatch& rows) const {
  const std::vector<std::uint32_t> regions =
      candidates_.regions_for_host(pair_seed_[pair], pair_region_[pair]);
  if (regions.size() == 1) return host.clip(pair_seed_[pair], regions.front(), moments, rows);
  if (rows.face_offset.empty()) rows.face_offset = rows.vertex_offset = {0};
  const std::size_t row = rows.face_offset.size() - 1;
  int status = PIECE_EMPTY;
  std::fill(moments.begin(), moments.end(), 0.0);
  std::vector<double> part(moments.size());
  for (const std::uint32_t region : regions) {
    const int of_part = host.clip(pair_seed_[pair], region, part, rows);
    if (of_part == PIECE_EMPTY) continue;
    if (status != PIECE_WHOLE) status = of_part;
    std::transform(part.begin(), part.end(), moments.begin(), moments.begin(), std::plus<>());
  }
  // Their rows become one, of walls alone: parts have no geometry in common.
  rows.repeats = true;
  rows.face_offset.resize(row + 1);
  rows.face_offset.push_back(static_cast<std::uint32_t>(rows.border.size()));
  rows.vertex_offset.resize(row + 1);
  rows.vertex_offset.push_back(
      static_cast<std::uint32_t>(rows.vertex.size() / static_cast<std::size_t>(scene_.mesh().dimension)));
  return status;
}

void Clipper::finish_on_host(const List& pairs) {
  if (pairs.empty()) return;
  if (!host_scene_) host_scene_ = make_host_scene(scene_);
  const std::size_t count = 2 + static_cast<std::size_t>(scene_.mesh().dimension);
  const std::size_t tasks = (pairs.size() + pairs_of_task - 1) / pairs_of_task,
                    first_batch = memory_.pieces.used;
  for (std::size_t task = 0; task < tasks; ++task) memory_.pieces.add_batch().clear();
  std::vector<double> moments(pairs.size() * count);
  std::vector<std::unique_ptr<HostClipper>> clipper(static_cast<std::size_t>(std::max(1, options_.threads)));
  parallel_tasks(options_.threads, tasks, [&](int worker, std::size_t task) {
    std::unique_ptr<HostClipper>& host = clipper[static_cast<std::size_t>(worker)];
    if (!host) host = HostClipper::make(*host_scene_, (outputs_ & OUTPUT_GEOMETRY) != 0);
    const std::size_t begin = task * pairs_of_task, end = std::min(begin + pairs_of_task, pairs.size());
    PieceBatch unwanted, &rows = wants_rows() ? memory_.pieces.batches[first_batch + task] : unwanted;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t pair = pairs[k];
      const int status = clip_on_host(*host, pair, std::span(moments).subspan(k * count, count), rows);
      memory_.pieces.status[pair] = static_cast<std::uint32_t>(status);
      memory_.pieces.batch[pair] = static_cast<std::uint32_t>(first_batch + task);
      memory_.pieces.row[pair] = static_cast<std::uint32_t>(k - begin);
    }
  });
  write_moments(pairs, moments);
  statistics_.on_host += pairs.size();
  write_log(LogLevel::detail, [&] { return "pieces finished on the host: " + std::to_string(pairs.size()); });
}

Clipper::List Clipper::begin(std::span<const std::uint32_t> pair_seed,
                             std::span<const std::uint32_t> pair_region) {
  memory_.pieces.used = 0;  // nobody needs those of the last chunk
  take_back_rows();
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
  List pending(count);
  std::iota(pending.begin(), pending.end(), 0U);
  return pending;
}

const PieceSet& Clipper::clip_with(std::size_t rung, std::span<const std::uint32_t> pair_seed,
                                   std::span<const std::uint32_t> pair_region) {
  Outcome outcome;
  run_rung(rung, begin(pair_seed, pair_region), outcome);
  return memory_.pieces;
}

const PieceSet& Clipper::clip(std::span<const std::uint32_t> pair_seed,
                              std::span<const std::uint32_t> pair_region) {
  List pending = begin(pair_seed, pair_region), last_resort;
  for (std::size_t rung = 0; rung < capacities(scene_.mesh().cell_dimension).size() && !pending.empty();
       ++rung) {
    if (rung > 0) {
      statistics_.retried += pending.size();
      write_log(LogLevel::detail, [&] {
        return "pieces tried again with room for " +
               std::to_string(capacities(scene_.mesh().cell_dimension)[rung].vertices) +
               " vertices: " + std::to_string(pending.size());
      });
    }
    Outcome outcome;
    run_rung(rung, pending, outcome);
    last_resort.insert(last_resort.end(), outcome.tangled.begin(), outcome.tangled.end());
    statistics_.uncertain += outcome.uncertain.size();
    if (options_.exact)
      last_resort.insert(last_resort.end(), outcome.uncertain.begin(), outcome.uncertain.end());
    pending = std::move(outcome.full);
    std::sort(pending.begin(), pending.end());
  }
  last_resort.insert(last_resort.end(), pending.begin(), pending.end());
  std::sort(last_resort.begin(), last_resort.end());
  finish_on_host(last_resort);
  return memory_.pieces;
}

}  // namespace powercell
