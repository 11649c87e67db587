#include "lib/diagram/clip.hpp"

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include "kernels/layout.h"
#include "lib/cl/quirks.hpp"
#include "lib/clip/in_chunks.hpp"
#include "lib/collect/geometry.hpp"
#include "lib/collect/periodic_walls.hpp"
#include "lib/collect/selected_walls.hpp"
#include "lib/diagram/chunk_pairs.hpp"
#include "lib/diagram/clip_chunk.hpp"
#include "lib/diagram/solid.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/diagram/unrestricted.hpp"
#include "lib/integrate/moment_sums.hpp"

namespace powercell {

namespace {

/// Of a proved reach, relative (82).
constexpr double proved_reach_error_double = 1.0 / (1 << MARGIN_BITS_DOUBLE),
                 proved_reach_error_float = 1.0 / (1 << MARGIN_BITS_FLOAT);
/// Of a margin that must be widened, against rounding.
constexpr double more_than_needed = 1.001;

int outputs_of(Wanted want, bool walls) {
  return OUTPUT_MOMENTS | (walls ? OUTPUT_WALLS : 0) | (want.cells ? OUTPUT_GEOMETRY : 0);
}

class Pass {
 public:
  Pass(const Setup& setup, Active& active, const Plan& plan, Wanted want, Workspace& workspace)
      : setup_(setup),
        active_(active),
        plan_(plan),
        want_(want),
        workspace_(workspace),
        exact_(setup.options.decisions == Decisions::exact || setup.boundary),
        overlaps_(setup.device.info().type == DeviceInfo::Type::gpu && plan.candidates &&
                  plan.candidates->is_shared()),
        measures_(setup.on_device, row_seeds(), setup.domain.measure(), setup.threads),
        walls_(collects_walls() && !active.images() && !plan.selected ? active.seeds().size() : 0,
               setup.threads, std::exchange(workspace.walls, {})),
        geometry_(plan.solid ? setup.clip_mesh : setup.domain.mesh(), active.seeds(),
                  setup.on_device.frame()) {
    if (!active.images()) {
      if (plan.selected && want.adjacency)
        selected_walls_.emplace(active.seeds(), row_seeds().size(), nullptr, setup.threads);
      return;
    }
    placement_.emplace(active.placement());
    geometry_.place(*placement_);
    proof_.emplace(*setup.period(), *active.images(),
                   setup.float32() ? proved_reach_error_float : proved_reach_error_double);
    if (want.adjacency && plan.selected)
      selected_walls_.emplace(active.seeds(), row_seeds().size(), &*placement_, setup.threads);
    else if (want.adjacency)
      periodic_walls_.emplace(*placement_, setup.threads);
  }

  Clipped run(Timings& timings) {
    if (!plan_.pairs.region.empty()) clip_all(timings);
    while (!beyond_.empty()) clip_beyond(timings);
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
  /// Calls clip_some(begin, end) for chunks of `total` pairs, with a clipper.
  template <class ClipSome>
  void in_clipped_chunks(std::uint64_t total, Candidates& candidates, Timings& timings,
                         const ClipSome& clip_some);
  Clipper make_clipper(std::optional<ClipMemory> memory) const;
  static void keep_memory(ClipChunk& chunk, std::optional<ClipMemory>& kept);
  /// The moments of the chunk that the host completes.
  PairMoments moments() {
    return {now_->clipper->moments_on_host(),
            [this]() -> const cl::RawBuffer& { return now_->clipper->moments(); }};
  }
  /// Cells that the boundary does not cut lie on the side of their neighbours, which are needed for that.
  bool collects_walls() const { return want_.adjacency || plan_.solid; }
  /// The seeds of the cells to compute, row by row: by rank unless they are selected.
  const SeedSet& row_seeds() const { return plan_.selected ? plan_.selected->seeds : active_.seeds(); }
  std::uint32_t rank_of_row(std::uint32_t row) const {
    return plan_.selected ? plan_.selected->rank[row] : row;
  }
  /// Clips and collects the pairs [begin, end). Where it pays, has the device clip those after them
  /// meanwhile.
  void clip_chunk(std::uint64_t begin, std::uint64_t end);
  /// The regions of the pairs of a chunk.
  std::span<const std::uint32_t> regions_of(const ClipChunk& chunk) const {
    return std::span(plan_.pairs.region).subspan(chunk.begin, chunk.end - chunk.begin);
  }
  std::vector<std::uint32_t> clip_on_device(ClipChunk& chunk) const {
    return chunk.clipper->clip_on_device(chunk.pair_seed, regions_of(chunk));
  }
  /// Has the device clip the pairs [begin, end) in another thread.
  void start_ahead(std::uint64_t begin, std::uint64_t end);
  /// Collects the pieces of the pairs in now_->pair_row, all but their measures.
  void collect(const PieceSet& pieces, std::span<const std::uint32_t> pair_region);
  /// Lists the cells that reach beyond the margin.
  void prove_reach(const PieceSet& pieces);
  void keep_reach(const PieceSet& pieces);
  /// Removes what was collected of some rows.
  void discard(std::span<const std::uint32_t> rows);
  void set_chunk_rows(ClipChunk& chunk, std::uint64_t begin, std::uint64_t end) const;
  /// Sets pair_seed from pair_row.
  void set_chunk_seeds(ClipChunk& chunk) const;
  std::uint32_t row_of(std::uint64_t pair) const;
  /// Moves the centroids from near the wrapped seeds to near those given.
  void place_centroids(Measures& measures) const;
  std::vector<CoincidentWall> coincident_walls(const std::vector<SeedStatus>& status) const;
  Clipped finish();
  void keep_wall_memory();

  const Setup& setup_;
  Active& active_;
  const Plan& plan_;
  const Wanted want_;
  Workspace& workspace_;
  const bool exact_;
  /// Whether the device clips a chunk while the host completes the one before it. The host's cores are idle
  /// then unless they are the device.
  bool overlaps_;
  MomentSums measures_;
  WallCollector walls_;
  GeometryCollector geometry_;
  std::unique_ptr<ClipChunk> now_ = std::make_unique<ClipChunk>(),
                             ahead_ = std::make_unique<ClipChunk>();  // used where a GPU clips
  std::vector<std::uint32_t> flat_;                                   // the row of each flat piece
  // In a periodic domain:
  std::optional<Placement> placement_;
  std::optional<MarginProof> proof_;
  std::optional<PeriodicWalls> periodic_walls_;
  std::optional<SelectedWalls> selected_walls_;
  std::vector<std::uint32_t> beyond_;  // ascending: rows of cells that reach too far
  double margin_ = 0;                  // that these need
  std::vector<double> reach_;          // by row of the results
  ClipStatistics done_;                // of finished chunks
  Candidates* candidates_ = nullptr;
  std::uint64_t total_ = 0;  // pairs
  double clip_seconds_ = 0, collect_seconds_ = 0;
};

std::uint32_t Pass::row_of(std::uint64_t pair) const {
  const auto& offset = plan_.pairs.offset;
  return static_cast<std::uint32_t>(std::upper_bound(offset.begin(), offset.end(), pair) - offset.begin() -
                                    1);
}

void Pass::set_chunk_rows(ClipChunk& chunk, std::uint64_t begin, std::uint64_t end) const {
  const std::vector<std::uint64_t>& offset = plan_.pairs.offset;
  chunk.begin = begin;
  chunk.end = end;
  chunk.pair_row.resize(end - begin);
  for (std::uint32_t row = row_of(begin); row <= row_of(end - 1); ++row) {
    const std::uint64_t from = std::max(begin, offset[row]), to = std::min(end, offset[row + 1]);
    if (to > from) std::fill_n(&chunk.pair_row[from - begin], to - from, row);
  }
  set_chunk_seeds(chunk);
}

void Pass::set_chunk_seeds(ClipChunk& chunk) const {
  chunk.pair_seed = chunk.pair_row;
  if (!plan_.selected) return;
  chunk.selected_seed.resize(chunk.pair_row.size());
  std::transform(chunk.pair_row.begin(), chunk.pair_row.end(), chunk.selected_seed.begin(),
                 [&](std::uint32_t row) { return rank_of_row(row); });
  chunk.pair_seed = chunk.selected_seed;
}

void Pass::start_ahead(std::uint64_t begin, std::uint64_t end) {
  if (!ahead_->clipper) ahead_->clipper.emplace(make_clipper({}));
  ahead_->clipper->share_host_scene(*now_->clipper);
  set_chunk_rows(*ahead_, begin, end);
  try {
    ahead_->for_host =
        std::async(std::launch::async, [this, &chunk = *ahead_] { return clip_on_device(chunk); });
  } catch (const std::system_error&) {
    // The system refuses another thread: the chunk is clipped when its turn comes.
  }
}

void Pass::clip_chunk(std::uint64_t begin, std::uint64_t end) {
  std::vector<std::uint32_t> for_host;
  if (ahead_->is_of(begin, end)) {
    for_host = ahead_->for_host.get();
    std::swap(now_, ahead_);
  } else {
    ahead_->drop();
    set_chunk_rows(*now_, begin, end);
    for_host = clip_on_device(*now_);
  }
  const std::uint64_t total = plan_.pairs.region.size();
  if (overlaps_ && end < total) start_ahead(end, std::min(total, end + (end - begin)));
  const std::span pair_region = regions_of(*now_);
  const PieceSet& pieces = now_->clipper->finish_on_host(
      for_host, plan_.split(setup_, active_, now_->pair_seed, pair_region, for_host));
  const Stopwatch watch(setup_.device);
  // This step may run out of device memory, and then adds nothing. No later step uses device memory.
  measures_.add(plan_.pairs.offset, begin, end, now_->pair_row.front(), now_->pair_row.back(), moments());
  collect(pieces, pair_region);
  collect_seconds_ += watch.seconds();
}

void Pass::collect(const PieceSet& pieces, std::span<const std::uint32_t> pair_region) {
  if (exact_)
    for (std::size_t k = 0; k < now_->pair_row.size(); ++k)
      if (pieces.status[k] == PIECE_FLAT) flat_.push_back(now_->pair_row[k]);
  if (proof_) prove_reach(pieces);
  if (want_.reach) keep_reach(pieces);
  if (selected_walls_)
    selected_walls_->add(now_->pair_row, now_->pair_seed, pieces);
  else if (periodic_walls_)
    periodic_walls_->add(now_->pair_seed, pieces);
  else if (collects_walls() && !plan_.selected)
    walls_.add(now_->pair_seed, pieces);
  if (want_.cells) geometry_.add(now_->pair_seed, pair_region, pieces);
}

void Pass::keep_reach(const PieceSet& pieces) {
  const double unit = setup_.on_device.frame().unit(1);
  reach_.resize(row_seeds().input_count);
  for (std::size_t k = 0; k < now_->pair_row.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    double& reach = reach_[row_seeds().input[now_->pair_row[k]]];
    reach = std::max(reach, pieces.reach[k] * unit);
  }
}

void Pass::prove_reach(const PieceSet& pieces) {
  const double unit = setup_.on_device.frame().unit(1);
  for (std::size_t k = 0; k < now_->pair_seed.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    const double margin = proof_->margin_for(now_->pair_seed[k], pieces.reach[k] * unit);
    if (margin > 0) beyond_.push_back(now_->pair_row[k]);
    margin_ = std::max(margin_, margin);
  }
}

void Pass::clip_all(Timings& timings) {
  done_ = plan_.solid_statistics;
  in_clipped_chunks(plan_.pairs.region.size(), *plan_.candidates, timings,
                    [&](std::uint64_t begin, std::uint64_t end) { clip_chunk(begin, end); });
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
  const std::vector<std::uint32_t> regions(rows.size());
  const std::unique_ptr<Candidates> candidates = search_all(setup_, active_.scene());
  in_clipped_chunks(rows.size(), *candidates, timings, [&](std::uint64_t begin, std::uint64_t end) {
    now_->pair_row.assign(rows.begin() + static_cast<std::ptrdiff_t>(begin),
                          rows.begin() + static_cast<std::ptrdiff_t>(end));
    set_chunk_seeds(*now_);
    const std::span pair_region = std::span(regions).subspan(begin, end - begin);
    const PieceSet& pieces = now_->clipper->clip(now_->pair_seed, pair_region);
    const Stopwatch watch(setup_.device);
    measures_.replace(now_->pair_row, moments());
    collect(pieces, pair_region);
    collect_seconds_ += watch.seconds();
  });
}

template <class ClipSome>
void Pass::in_clipped_chunks(std::uint64_t total, Candidates& candidates, Timings& timings,
                             const ClipSome& clip_some) {
  candidates_ = &candidates;
  total_ = total;
  now_->clipper.emplace(make_clipper(std::exchange(workspace_.clip, std::nullopt)));
  if (workspace_.clip_ahead)
    ahead_->clipper.emplace(make_clipper(std::exchange(workspace_.clip_ahead, std::nullopt)));
  const std::function<bool(double)>& progress = setup_.options.progress;
  const double list_seconds_before = candidates.host_seconds(), collected_before = collect_seconds_;
  const Stopwatch watch(setup_.device);
  in_chunks(
      total, {chunk_pairs(setup_, total), least_chunk_pairs, "pairs"},
      [&](std::uint64_t begin, std::uint64_t end) {
        clip_some(begin, end);
        done_.add(now_->clipper->take_statistics());
        write_log(LogLevel::detail,
                  [&] { return std::to_string(end) + " of " + std::to_string(total) + " pairs clipped"; });
        if (progress && !progress(static_cast<double>(end) / static_cast<double>(total)))
          throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
      },
      [&] {
        ahead_->drop();
        ahead_->clipper.reset();
        overlaps_ = false;  // there is too little memory for two chunks
        now_->clipper.emplace(make_clipper({}));
      });
  const double list_seconds = candidates.host_seconds() - list_seconds_before;
  timings.neighbors += list_seconds;
  clip_seconds_ += watch.seconds() - (collect_seconds_ - collected_before) - list_seconds;
  keep_memory(*now_, workspace_.clip);
  keep_memory(*ahead_, workspace_.clip_ahead);
}

Clipper Pass::make_clipper(std::optional<ClipMemory> memory) const {
  return Clipper(active_.scene(), *candidates_,
                 outputs_of(want_, collects_walls()) | (proof_ || want_.reach ? OUTPUT_REACH : 0),
                 ClipOptions{.exact = exact_, .threads = setup_.threads, .pairs = total_}, std::move(memory));
}

void Pass::keep_memory(ClipChunk& chunk, std::optional<ClipMemory>& kept) {
  chunk.drop();
  if (!chunk.clipper) return;
  ClipMemory memory = std::move(*chunk.clipper).release();
  chunk.clipper.reset();
  if (memory.bytes() <= kept_bytes) kept = std::move(memory);
}

void Pass::keep_wall_memory() {
  WallRows::Memory memory = std::move(walls_).release();
  std::size_t bytes = 0;
  for (const auto& words : memory) bytes += words.bytes();
  if (bytes <= kept_bytes) workspace_.walls = std::move(memory);
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
  results.measures = std::move(measures);
  return results;
}

}  // namespace

Clipped clip(const Setup& setup, Active& active, const Plan& plan, Wanted want, Workspace& workspace,
             Timings& timings) {
  return Pass(setup, active, plan, want, workspace).run(timings);
}

}  // namespace powercell
