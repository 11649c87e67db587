#include "lib/diagram/clip.hpp"

#include <algorithm>
#include <utility>

#include "kernels/layout.h"
#include "lib/clip/in_chunks.hpp"
#include "lib/collect/geometry.hpp"
#include "lib/collect/periodic_walls.hpp"
#include "lib/collect/selected_walls.hpp"
#include "lib/diagram/chunk_pairs.hpp"
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
  /// Cells that the boundary does not cut lie on the side of their neighbours, which are needed for that.
  bool collects_walls() const { return want_.adjacency || plan_.solid; }
  /// The seeds of the cells to compute, row by row: by rank unless they are selected.
  const SeedSet& row_seeds() const { return plan_.selected ? plan_.selected->seeds : active_.seeds(); }
  std::uint32_t rank_of_row(std::uint32_t row) const {
    return plan_.selected ? plan_.selected->rank[row] : row;
  }
  /// Clips and collects the pairs [begin, end).
  void clip_chunk(std::uint64_t begin, std::uint64_t end);
  /// Collects the pieces of the pairs in pair_row_, all but their measures.
  void collect(const PieceSet& pieces, std::span<const std::uint32_t> pair_region);
  /// Lists the cells that reach beyond the margin.
  void prove_reach(const PieceSet& pieces);
  /// Removes what was collected of some rows.
  void discard(std::span<const std::uint32_t> rows);
  void set_chunk_rows(std::uint64_t begin, std::uint64_t end);
  /// Sets pair_seed_ from pair_row_.
  void set_chunk_seeds();
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
  std::optional<Clipper> clipper_;
  MomentSums measures_;
  WallCollector walls_;
  GeometryCollector geometry_;
  std::vector<std::uint32_t> pair_row_;       // of a chunk
  std::vector<std::uint32_t> selected_seed_;  // the same by rank, if cells are selected
  std::span<const std::uint32_t> pair_seed_;  // the same by rank
  std::vector<std::uint32_t> flat_;           // the row of each flat piece
  // In a periodic domain:
  std::optional<Placement> placement_;
  std::optional<MarginProof> proof_;
  std::optional<PeriodicWalls> periodic_walls_;
  std::optional<SelectedWalls> selected_walls_;
  std::vector<std::uint32_t> beyond_;  // ascending: rows of cells that reach too far
  double margin_ = 0;                  // that these need
  ClipStatistics done_;                // of discarded clippers
  double clip_seconds_ = 0, collect_seconds_ = 0;
};

std::uint32_t Pass::row_of(std::uint64_t pair) const {
  const auto& offset = plan_.pairs.offset;
  return static_cast<std::uint32_t>(std::upper_bound(offset.begin(), offset.end(), pair) - offset.begin() -
                                    1);
}

void Pass::set_chunk_rows(std::uint64_t begin, std::uint64_t end) {
  const std::vector<std::uint64_t>& offset = plan_.pairs.offset;
  pair_row_.resize(end - begin);
  for (std::uint32_t row = row_of(begin); row <= row_of(end - 1); ++row) {
    const std::uint64_t from = std::max(begin, offset[row]), to = std::min(end, offset[row + 1]);
    if (to > from) std::fill_n(&pair_row_[from - begin], to - from, row);
  }
  set_chunk_seeds();
}

void Pass::set_chunk_seeds() {
  pair_seed_ = pair_row_;
  if (!plan_.selected) return;
  selected_seed_.resize(pair_row_.size());
  std::transform(pair_row_.begin(), pair_row_.end(), selected_seed_.begin(),
                 [&](std::uint32_t row) { return rank_of_row(row); });
  pair_seed_ = selected_seed_;
}

void Pass::clip_chunk(std::uint64_t begin, std::uint64_t end) {
  set_chunk_rows(begin, end);
  const std::span pair_region(plan_.pairs.region.data() + begin, end - begin);
  const std::vector<std::uint32_t> for_host = clipper_->clip_on_device(pair_seed_, pair_region);
  const PieceSet& pieces =
      clipper_->finish_on_host(for_host, plan_.split(setup_, active_, pair_seed_, pair_region, for_host));
  const Stopwatch watch(setup_.device);
  // This step may run out of device memory, and then adds nothing. No later step uses device memory.
  measures_.add(plan_.pairs.offset, begin, end, pair_row_.front(), pair_row_.back(), clipper_->moments(),
                clipper_->moments_on_host());
  collect(pieces, pair_region);
  collect_seconds_ += watch.seconds();
}

void Pass::collect(const PieceSet& pieces, std::span<const std::uint32_t> pair_region) {
  if (exact_)
    for (std::size_t k = 0; k < pair_row_.size(); ++k)
      if (pieces.status[k] == PIECE_FLAT) flat_.push_back(pair_row_[k]);
  if (proof_) prove_reach(pieces);
  if (selected_walls_)
    selected_walls_->add(pair_row_, pair_seed_, pieces);
  else if (periodic_walls_)
    periodic_walls_->add(pair_seed_, pieces);
  else if (collects_walls() && !plan_.selected)
    walls_.add(pair_seed_, pieces);
  if (want_.cells) geometry_.add(pair_seed_, pair_region, pieces);
}

void Pass::prove_reach(const PieceSet& pieces) {
  const double unit = setup_.on_device.frame().unit(1);
  for (std::size_t k = 0; k < pair_seed_.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    const double margin = proof_->margin_for(pair_seed_[k], pieces.reach[k] * unit);
    if (margin > 0) beyond_.push_back(pair_row_[k]);
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
    pair_row_.assign(rows.begin() + static_cast<std::ptrdiff_t>(begin),
                     rows.begin() + static_cast<std::ptrdiff_t>(end));
    set_chunk_seeds();
    const std::span pair_region = std::span(regions).subspan(begin, end - begin);
    const PieceSet& pieces = clipper_->clip(pair_seed_, pair_region);
    const Stopwatch watch(setup_.device);
    measures_.replace(pair_row_, clipper_->moments(), clipper_->moments_on_host());
    collect(pieces, pair_region);
    collect_seconds_ += watch.seconds();
  });
}

template <class ClipSome>
void Pass::in_clipped_chunks(std::uint64_t total, Candidates& candidates, Timings& timings,
                             const ClipSome& clip_some) {
  const auto make_clipper = [&](std::optional<ClipMemory> memory) {
    clipper_.emplace(
        active_.scene(), candidates, outputs_of(want_, collects_walls()) | (proof_ ? OUTPUT_REACH : 0),
        ClipOptions{.exact = exact_, .threads = setup_.threads, .pairs = total}, std::move(memory));
  };
  make_clipper(std::exchange(workspace_.clip, std::nullopt));
  const std::function<bool(double)>& progress = setup_.options.progress;
  const double list_seconds_before = candidates.host_seconds(), collected_before = collect_seconds_;
  ClipStatistics before;  // at the beginning of a chunk
  const Stopwatch watch(setup_.device);
  in_chunks(
      total, {chunk_pairs(setup_, total), least_chunk_pairs, "pairs"},
      [&](std::uint64_t begin, std::uint64_t end) {
        before = clipper_->statistics();
        clip_some(begin, end);
        write_log(LogLevel::detail,
                  [&] { return std::to_string(end) + " of " + std::to_string(total) + " pairs clipped"; });
        if (progress && !progress(static_cast<double>(end) / static_cast<double>(total)))
          throw Error(ErrorCode::interrupted, "the computation was stopped by its progress callback");
      },
      [&] {
        done_.add(before);
        make_clipper({});
      });
  const double list_seconds = candidates.host_seconds() - list_seconds_before;
  timings.neighbors += list_seconds;
  clip_seconds_ += watch.seconds() - (collect_seconds_ - collected_before) - list_seconds;
  done_.add(clipper_->statistics());
  ClipMemory memory = std::move(*clipper_).release();
  clipper_.reset();
  if (memory.bytes() <= kept_bytes) workspace_.clip = std::move(memory);
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
  results.measures = std::move(measures);
  return results;
}

}  // namespace

Clipped clip(const Setup& setup, Active& active, const Plan& plan, Wanted want, Workspace& workspace,
             Timings& timings) {
  return Pass(setup, active, plan, want, workspace).run(timings);
}

}  // namespace powercell
