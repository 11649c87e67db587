#include "lib/diagram/clip.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <utility>

#include "kernels/layout.h"
#include "lib/clip/in_chunks.hpp"
#include "lib/collect/geometry.hpp"
#include "lib/collect/periodic_walls.hpp"
#include "lib/collect/selected_walls.hpp"
#include "lib/diagram/chunk_pairs.hpp"
#include "lib/diagram/chunk_pipeline.hpp"
#include "lib/diagram/solid.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/diagram/unrestricted.hpp"
#include "lib/integrate/moment_sums.hpp"

namespace powercell {

namespace {

/// Of a proved reach, relative (82).
constexpr double proved_reach_error_double = 1.0 / (1 << MARGIN_BITS_DOUBLE),
                 proved_reach_error_float = 1.0 / (1 << MARGIN_BITS_FLOAT);
/// Fewer pairs are clipped faster by one device than by several.
constexpr std::uint64_t least_shared_pairs = 16384;
/// Of a margin that must be widened, against rounding.
constexpr double more_than_needed = 1.001;

int outputs_of(Wanted want, bool walls) {
  return OUTPUT_MOMENTS | (walls ? OUTPUT_WALLS : 0) | (want.cells ? OUTPUT_GEOMETRY : 0);
}

class Pass {
 public:
  Pass(const Setup& setup, Active& active, Plan& plan, Wanted want, Workspace& workspace)
      : setup_(setup),
        active_(active),
        plan_(plan),
        want_(want),
        workspace_(workspace),
        exact_(setup.options.decisions == Decisions::exact || setup.boundary),
        measures_(setup.on_device, row_seeds(), setup.domain.measure(), setup.threads),
        walls_(collects_walls() && !active.images() ? row_seeds().size() : 0, setup.threads,
               std::exchange(workspace.walls, {})),
        geometry_(plan.solid ? setup.clip_mesh : setup.domain.mesh(), active.seeds(),
                  setup.on_device.frame()) {
    if (!active.images()) return;
    placement_.emplace(active.placement());
    geometry_.place(*placement_);
    proof_.emplace(*setup.period(), *active.images(),
                   setup.float32() ? proved_reach_error_float : proved_reach_error_double);
    if (want.adjacency && plan.selected)
      selected_walls_.emplace(*placement_, row_seeds().size(), setup.threads);
    else if (want.adjacency)
      periodic_walls_.emplace(*placement_, setup.threads);
  }

  Clipped run(Timings& timings) {
    if (!plan_.pairs.region.empty()) clip_all(timings);
    while (!beyond_.empty() && !want_.unproved) clip_beyond(timings);
    const Stopwatch watch(setup_.device);
    Clipped results = finish();
    keep_wall_memory();
    timings.collect = collect_seconds_ + watch.seconds();
    timings.clip = clip_seconds_;
    timings.retried = done_.retried;
    timings.on_host = done_.on_host;
    timings.uncertain = done_.uncertain;
    timings.rounds = done_.rounds;
    return results;
  }

 private:
  void clip_all(Timings& timings);
  /// Clips the cells that reached beyond the margin again, among more images.
  void clip_beyond(Timings& timings);
  /// Calls `body`, which clips by these candidates, and adds its time to the timings.
  template <class Body>
  void timed(const Candidates& candidates, Timings& timings, const Body& body);
  /// \param overlapping  whether a device clips a chunk while the host completes another
  ClipWork work(std::uint64_t total, bool overlapping = false) const;
  /// Whether so many pairs are worth more than one device.
  bool is_shared(std::uint64_t total) const;
  /// Clips and completes the pairs [begin, end) one chunk after the other. \return the size of a chunk at the
  /// end
  std::uint64_t clip_in_turn(ClipDevice& device, ClipChunk& chunk, std::uint64_t begin, std::uint64_t end,
                             std::uint64_t size);
  /// Has the devices clip all pairs while the host completes them. \return false if the system gives no
  /// thread
  bool clip_in_pipeline(std::deque<ClipDevice>& devices, Sharing sharing, std::size_t chunks);
  void keep_shares(const Sharing& sharing, const std::vector<std::uint64_t>& pairs);
  /// Completes a chunk on the host and collects it.
  void complete(ClipChunk& chunk);
  /// To be called for each chunk, when `done` pairs of `total` are.
  void report(ClipChunk& chunk, std::uint64_t done, std::uint64_t total);
  /// The moments of a chunk that the host completes.
  static PairMoments moments(ClipChunk& chunk) {
    return {chunk.clipper->moments_on_host(),
            [&chunk]() -> const cl::RawBuffer& { return chunk.clipper->moments(); }};
  }
  /// Cells that the boundary does not cut lie on the side of their neighbours, which are needed for that.
  bool collects_walls() const { return want_.adjacency || plan_.solid; }
  /// The seeds of the cells to compute, row by row: by rank unless they are selected.
  const SeedSet& row_seeds() const { return plan_.selected ? plan_.selected->seeds : active_.seeds(); }
  std::uint32_t rank_of_row(std::uint32_t row) const {
    return plan_.selected ? plan_.selected->rank[row] : row;
  }
  /// Collects the pieces of a chunk, all but their measures.
  void collect(const ClipChunk& chunk, const PieceSet& pieces);
  /// Lists the cells that reach beyond the margin.
  void prove_reach(const ClipChunk& chunk, const PieceSet& pieces);
  void keep_reach(const ClipChunk& chunk, const PieceSet& pieces);
  /// Removes what was collected of some rows.
  void discard(std::span<const std::uint32_t> rows);
  /// Moves the centroids from near the wrapped seeds to near those given.
  void place_centroids(Measures& measures) const;
  std::vector<CoincidentWall> coincident_walls(const std::vector<SeedStatus>& status) const;
  Clipped finish();
  void keep_wall_memory();

  const Setup& setup_;
  Active& active_;
  Plan& plan_;
  const Wanted want_;
  Workspace& workspace_;
  const bool exact_;
  MomentSums measures_;
  WallCollector walls_;
  GeometryCollector geometry_;
  std::vector<std::uint32_t> flat_;  // the row of each flat piece
  // In a periodic domain:
  std::optional<Placement> placement_;
  std::optional<MarginProof> proof_;
  std::optional<PeriodicWalls> periodic_walls_;
  std::optional<SelectedWalls> selected_walls_;
  std::vector<std::uint32_t> beyond_;  // ascending: rows of cells that reach too far
  double margin_ = 0;                  // that these need
  std::vector<double> reach_;          // by row of the results
  ClipStatistics done_;                // of finished chunks
  Clipper::SharedHostScene host_scene_ = std::make_shared<std::optional<HostScene>>();
  double clip_seconds_ = 0, collect_seconds_ = 0;
};

void Pass::complete(ClipChunk& chunk) {
  chunk.clipper->share_host_scene(host_scene_);
  const PieceSet& pieces = chunk.clipper->finish_on_host(
      chunk.for_host, plan_.split(setup_, active_, chunk.pair_seed, chunk.pair_region, chunk.for_host));
  const Stopwatch watch(setup_.device);
  // This step may run out of device memory, and then adds nothing. No later step uses device memory.
  measures_.add(plan_.pairs.offset, chunk.begin, chunk.end, chunk.pair_row.front(), chunk.pair_row.back(),
                moments(chunk));
  collect(chunk, pieces);
  collect_seconds_ += watch.seconds();
}

void Pass::collect(const ClipChunk& chunk, const PieceSet& pieces) {
  if (exact_)
    for (std::size_t k = 0; k < chunk.pair_row.size(); ++k)
      if (pieces.status[k] == PIECE_FLAT) flat_.push_back(chunk.pair_row[k]);
  if (proof_) prove_reach(chunk, pieces);
  if (want_.reach) keep_reach(chunk, pieces);
  if (selected_walls_)
    selected_walls_->add(chunk.pair_row, chunk.pair_seed, pieces);
  else if (periodic_walls_)
    periodic_walls_->add(chunk.pair_seed, pieces);
  else if (collects_walls())
    walls_.add(chunk.pair_row, pieces);
  if (want_.cells) geometry_.add(chunk.pair_seed, chunk.pair_region, pieces);
}

void Pass::keep_reach(const ClipChunk& chunk, const PieceSet& pieces) {
  const double unit = setup_.on_device.frame().unit(1);
  reach_.resize(row_seeds().input_count);
  for (std::size_t k = 0; k < chunk.pair_row.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    double& reach = reach_[row_seeds().input[chunk.pair_row[k]]];
    reach = std::max(reach, pieces.reach[k] * unit);
  }
}

void Pass::prove_reach(const ClipChunk& chunk, const PieceSet& pieces) {
  const double unit = setup_.on_device.frame().unit(1);
  for (std::size_t k = 0; k < chunk.pair_seed.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    const double margin = proof_->margin_for(chunk.pair_seed[k], pieces.reach[k] * unit);
    if (margin > 0) beyond_.push_back(chunk.pair_row[k]);
    margin_ = std::max(margin_, margin);
  }
}

void Pass::clip_all(Timings& timings) {
  done_ = plan_.solid_statistics;
  const std::uint64_t total = plan_.pairs.region.size();
  const bool shared = is_shared(total);
  std::deque<ClipDevice> devices;
  std::vector<Sharing::Member> members;
  plan_.copies.resize(setup_.members.size() - 1);
  // The host's cores are idle while one device clips, unless they are the device.
  const bool overlaps =
      shared || (setup_.device.info().type == DeviceInfo::Type::gpu && plan_.candidates->is_shared() &&
                 chunk_pairs(setup_, setup_.members[0], total) < total);
  for (std::size_t k = 0; k < (shared ? setup_.members.size() : 1); ++k) {
    DeviceWorkspace& kept = workspace_.devices[k];
    const Device& device = setup_.members[k];
    if (k == 0)
      devices.emplace_back(work(total, overlaps), device, kept, *plan_.candidates);
    else
      devices.emplace_back(work(total, overlaps), device, kept, *plan_.candidates, plan_.copies[k - 1]);
    members.push_back({chunk_pairs(setup_, device, shared ? 0 : total), kept.speed});
  }
  timed(*plan_.candidates, timings, [&] {
    if (!overlaps || !clip_in_pipeline(devices, Sharing(total, least_chunk_pairs, members),
                                       plan_.candidates->is_shared() ? 2 : 1))
      clip_in_turn(devices[0], devices[0].chunks()[0], 0, total,
                   chunk_pairs(setup_, setup_.members[0], total));
  });
  for (ClipDevice& device : devices) device.keep_memory();
}

bool Pass::is_shared(std::uint64_t total) const {
  if (setup_.members.size() == 1) return false;
  return total >= least_shared_pairs ||
         (setup_.options.chunk_pairs > 0 && setup_.options.chunk_pairs < total);
}

ClipWork Pass::work(std::uint64_t total, bool overlapping) const {
  return {
      setup_, active_, outputs_of(want_, collects_walls()) | (proof_ || want_.reach ? OUTPUT_REACH : 0),
      ClipOptions{.exact = exact_, .threads = setup_.threads, .pairs = total, .read_moments = overlapping}};
}

std::uint64_t Pass::clip_in_turn(ClipDevice& device, ClipChunk& chunk, std::uint64_t begin, std::uint64_t end,
                                 std::uint64_t size) {
  return in_chunks(
      end - begin, {size, least_chunk_pairs, "pairs"},
      [&](std::uint64_t first, std::uint64_t last) {
        chunk.set_pairs(plan_, begin + first, begin + last);
        device.clip(chunk);
        device.use([&] { complete(chunk); });
        report(chunk, chunk.end, plan_.pairs.region.size());
      },
      [&] { device.free_memory(chunk); });
}

bool Pass::clip_in_pipeline(std::deque<ClipDevice>& devices, Sharing sharing, std::size_t chunks) {
  std::vector<std::uint64_t> pairs(devices.size());
  const std::uint64_t total = plan_.pairs.region.size();
  {
    ChunkPipeline pipeline(devices, plan_, sharing, chunks);
    if (!pipeline.start()) return false;
    for (std::uint64_t begin = 0; begin < total;) {
      const ChunkPipeline::Done done = pipeline.wait_for(begin);
      const std::uint64_t end = done.chunk->end;
      if (done.is_clipped) {
        complete(*done.chunk);  // whose moments are on the host: this does not use the device
        report(*done.chunk, end, total);
      } else {
        pipeline.take_over(done);
        pipeline.limit(done.device, clip_in_turn(devices[done.device], *done.chunk, begin, end, end - begin));
      }
      pipeline.release(done);
      pairs[done.device] += end - begin;
      begin = end;
    }
  }
  keep_shares(sharing, pairs);
  return true;
}

void Pass::keep_shares(const Sharing& sharing, const std::vector<std::uint64_t>& pairs) {
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k] > 0) workspace_.devices[k].speed = sharing.speed(k);
    workspace_.devices[k].pairs = pairs[k];
  }
  if (pairs.size() == 1) return;
  write_log(LogLevel::info, [&] {
    std::string shares;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      shares += (k > 0 ? ", " : "") + setup_.members[k].info().selector() + " " + std::to_string(pairs[k]);
    return "pairs clipped by each device: " + shares;
  });
}

void Pass::report(ClipChunk& chunk, std::uint64_t done, std::uint64_t total) {
  done_.add(chunk.clipper->take_statistics());
  write_log(LogLevel::detail,
            [&] { return std::to_string(done) + " of " + std::to_string(total) + " pairs clipped"; });
  const std::function<bool(double)>& progress = setup_.options.progress;
  if (progress && !progress(static_cast<double>(done) / static_cast<double>(total)))
    throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
}

template <class Body>
void Pass::timed(const Candidates& candidates, Timings& timings, const Body& body) {
  const double list_seconds_before = candidates.host_seconds(), collected_before = collect_seconds_;
  const Stopwatch watch(setup_.device);
  body();
  const double list_seconds = candidates.host_seconds() - list_seconds_before;
  timings.neighbors += list_seconds;
  // Several devices make lists while others clip, so that the sum of the parts may be more than the whole.
  clip_seconds_ += std::max(0.0, watch.seconds() - (collect_seconds_ - collected_before) - list_seconds);
}

void Pass::discard(std::span<const std::uint32_t> rows) {
  std::erase_if(flat_, [&](std::uint32_t row) { return std::binary_search(rows.begin(), rows.end(), row); });
  std::vector<std::uint32_t> ranks;
  for (const std::uint32_t row : rows) {
    ranks.push_back(rank_of_row(row));
    if (selected_walls_) selected_walls_->discard(row);
  }
  geometry_.discard(ranks);
}

void Pass::clip_beyond(Timings& timings) {
  // A cell that lacks an image reaches farther than it will.
  active_.widen(std::min(more_than_needed * margin_, 2 * active_.images()->margin));
  margin_ = 0;
  const std::vector<std::uint32_t> rows = std::exchange(beyond_, {});
  write_log(LogLevel::info, [&] {
    return std::to_string(active_.seeds().size() - active_.images()->own) + " images of " +
           std::to_string(active_.images()->own) + " seeds, because " + std::to_string(rows.size()) +
           " cells reached beyond a narrower margin";
  });
  discard(rows);
  host_scene_ = std::make_shared<std::optional<HostScene>>();
  const std::vector<std::uint32_t> regions(rows.size());
  const std::unique_ptr<Candidates> candidates = search_all(setup_, active_.scene());
  const std::uint64_t total = rows.size();
  const Device& first = setup_.members.front();
  ClipDevice device(work(total), first, workspace_.devices[0], *candidates);
  ClipChunk& chunk = device.chunks()[0];
  timed(*candidates, timings, [&] {
    in_chunks(
        total, {chunk_pairs(setup_, first, total), least_chunk_pairs, "pairs"},
        [&](std::uint64_t begin, std::uint64_t end) {
          chunk.pair_row.assign(rows.begin() + static_cast<std::ptrdiff_t>(begin),
                                rows.begin() + static_cast<std::ptrdiff_t>(end));
          chunk.set_seeds(plan_);
          chunk.pair_region = std::span(regions).subspan(begin, end - begin);
          device.clip(chunk);
          chunk.clipper->share_host_scene(host_scene_);
          const PieceSet& pieces = chunk.clipper->finish_on_host(chunk.for_host);
          const Stopwatch watch(setup_.device);
          measures_.replace(chunk.pair_row, moments(chunk));
          collect(chunk, pieces);
          collect_seconds_ += watch.seconds();
          report(chunk, end, total);
        },
        [&] { device.free_memory(chunk); });
  });
  device.keep_memory();
}

void Pass::keep_wall_memory() {
  WallRows::Memory memory = std::move(walls_).release();
  std::size_t bytes = 0;
  for (const auto& words : memory) bytes += words.bytes();
  if (workspace_.keeps_walls || bytes <= kept_bytes) workspace_.walls = std::move(memory);
}

void Pass::place_centroids(Measures& measures) const {
  const auto d = static_cast<std::size_t>(measures.dimension);
  const std::size_t rows = plan_.selected ? plan_.selected->rank.size() : active_.images()->own;
  for (std::uint32_t row = 0; row < rows; ++row) {
    if (placement_->is_inside(rank_of_row(row))) continue;
    const std::array<double, 3> offset = placement_->offset(rank_of_row(row));
    for (std::size_t c = 0; c < d; ++c) measures.centroid[row_seeds().input[row] * d + c] += offset[c];
  }
}

std::vector<CoincidentWall> Pass::coincident_walls(const std::vector<SeedStatus>& status) const {
  std::vector<CoincidentWall> walls;
  const std::vector<std::uint32_t>& seed = active_.seeds().input;
  for (const SolidCells::Coincidence& c : plan_.solid->coincidences)
    if (status[seed[c.rank]] == SeedStatus::ok && status[seed[c.neighbor]] == SeedStatus::ok)
      walls.push_back({seed[c.rank], seed[c.neighbor], c.triangle});
  return walls;
}

Clipped Pass::finish() {
  const SeedSet& seeds = row_seeds();
  Clipped results;
  std::vector<std::uint32_t> outside;
  std::vector<CellAtBoundary> at_boundary;
  if (plan_.solid) {
    const SolidSides sides = add_solid_cells(setup_, active_, plan_, measures_, walls_);
    results.unclear = sides.unclear;
    outside = sides.outside;
    at_boundary = sides.geometry;
    flat_.insert(flat_.end(), sides.flat.begin(), sides.flat.end());
    std::sort(flat_.begin(), flat_.end());
  }
  Measures measures = measures_.finish();
  for (const std::uint32_t rank : outside) clear_cell(measures, seeds.input[rank]);
  flat_.erase(std::unique(flat_.begin(), flat_.end()), flat_.end());
  std::erase_if(flat_, [&](std::uint32_t row) { return measures.mass[seeds.input[row]] > 0; });
  for (std::uint32_t& row : flat_) row = rank_of_row(row);
  results.flat = std::move(flat_);
  if (!results.flat.empty()) return results;
  if (plan_.unrestricted) results.unclear = classify_unrestricted_cells(setup_, seeds, plan_.pairs, measures);
  if (!results.unclear.empty()) return results;
  const double unit = setup_.on_device.frame().unit(setup_.domain.cell_dimension() - 1);
  const double negligible = exact_ ? 0 : setup_.float32() ? NEGLIGIBLE_WALL_FLOAT : NEGLIGIBLE_WALL_DOUBLE;
  if (selected_walls_)
    results.adjacency = selected_walls_->finish(seeds.input, measures.status, unit);
  else if (periodic_walls_)
    results.adjacency = periodic_walls_->finish(measures.status, unit, negligible);
  else if (want_.adjacency && plan_.selected)
    results.adjacency =
        walls_.finish_selected(active_.seeds(), seeds.input, measures.status, unit, want_.walls);
  else if (want_.adjacency)
    results.adjacency = walls_.finish(seeds, measures.status, unit, negligible);
  if (want_.cells && plan_.solid)
    results.solid =
        join_solid({setup_.domain, geometry_.finish(measures.status, seeds), at_boundary,
                    coincident_walls(measures.status), seeds, setup_.on_device.frame(), measures.status});
  else if (want_.cells)
    results.cells =
        geometry_.finish(measures.status, seeds, plan_.selected ? &plan_.selected->rank : nullptr);
  if (placement_) place_centroids(measures);
  if (want_.reach) {
    reach_.resize(row_seeds().input_count);
    results.reach = std::move(reach_);
  }
  for (const std::uint32_t row : beyond_) results.unproved.push_back(row_seeds().input[row]);
  std::sort(results.unproved.begin(), results.unproved.end());
  results.measures = std::move(measures);
  return results;
}

}  // namespace

Clipped clip(const Setup& setup, Active& active, Plan& plan, Wanted want, Workspace& workspace,
             Timings& timings) {
  return Pass(setup, active, plan, want, workspace).run(timings);
}

}  // namespace powercell
