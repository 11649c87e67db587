#include "lib/diagram/cell_collector.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "kernels/layout.h"
#include "lib/diagram/solid.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/diagram/unrestricted.hpp"

namespace powercell {
namespace {

/// Of a proved reach, relative (82).
constexpr double proved_reach_error_double = 1.0 / (1 << MARGIN_BITS_DOUBLE),
                 proved_reach_error_float = 1.0 / (1 << MARGIN_BITS_FLOAT);

}  // namespace

CellCollector::CellCollector(const DiagramSetup& setup, ActiveSeeds& active, ClipPlan& plan, Wanted want,
                             Workspace& workspace)
    : setup_(setup),
      active_(active),
      plan_(plan),
      want_(want),
      workspace_(workspace),
      measures_(setup.on_device, row_seeds(), setup.domain.measure(), setup.threads),
      walls_(collects_walls() ? row_count() : 0, setup.threads, std::exchange(workspace.walls, {})),
      geometry_(plan.solid ? setup.clip_mesh : setup.domain.mesh(), active.seeds(), setup.on_device.frame()) {
  if (!active.images()) return;
  placement_.emplace(active.placement());
  geometry_.place(*placement_);
  proof_.emplace(*setup.period(), *active.images(),
                 setup.float32() ? proved_reach_error_float : proved_reach_error_double);
  clearance_.assign(active.images()->own, std::numeric_limits<double>::infinity());
}

int CellCollector::outputs() const {
  return OUTPUT_MOMENTS | (collects_walls() ? OUTPUT_WALLS : 0) | (want_.cells ? OUTPUT_GEOMETRY : 0) |
         (proof_ || want_.reach ? OUTPUT_REACH : 0);
}

void CellCollector::add(ClipChunk& chunk, const PieceSet& pieces) {
  const Stopwatch watch(setup_.device);
  // This step may run out of device memory, and then adds nothing. No later step uses device memory.
  measures_.add(plan_.pairs.offset, chunk.begin, chunk.end, chunk.pair_row.front(), chunk.pair_row.back(),
                moments(chunk));
  collect(chunk, pieces);
  seconds_ += watch.seconds();
}

void CellCollector::replace(ClipChunk& chunk, const PieceSet& pieces) {
  const Stopwatch watch(setup_.device);
  measures_.replace(chunk.pair_row, moments(chunk));
  collect(chunk, pieces);
  seconds_ += watch.seconds();
}

void CellCollector::collect(const ClipChunk& chunk, const PieceSet& pieces) {
  if (setup_.exact())
    for (std::size_t k = 0; k < chunk.pair_row.size(); ++k)
      if (pieces.status[k] == PIECE_FLAT) flat_.push_back(chunk.pair_row[k]);
  if (proof_) prove_reach(chunk, pieces);
  if (want_.reach) keep_reach(chunk, pieces);
  if (collects_walls()) walls_.add(chunk.pair_row, pieces);
  if (want_.cells) geometry_.add(chunk.pair_seed, chunk.pair_region, pieces);
}

void CellCollector::keep_reach(const ClipChunk& chunk, const PieceSet& pieces) {
  const double unit = setup_.on_device.frame().unit(1);
  reach_.resize(row_seeds().input_count);
  for (std::size_t k = 0; k < chunk.pair_row.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    double& reach = reach_[row_seeds().input[chunk.pair_row[k]]];
    reach = std::max(reach, pieces.reach[k] * unit);
  }
}

void CellCollector::prove_reach(const ClipChunk& chunk, const PieceSet& pieces) {
  const double unit = setup_.on_device.frame().unit(1);
  for (std::size_t k = 0; k < chunk.pair_seed.size(); ++k) {
    double& clearance = clearance_[chunk.pair_seed[k]];
    if (pieces.status[k] == PIECE_EMPTY) clearance = 0;  // and so are the cells of all images
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    clearance = proof_->clearance(chunk.pair_seed[k], pieces.reach[k] * unit);
    const double margin = proof_->margin_for(chunk.pair_seed[k], clearance);
    if (margin > 0) beyond_.push_back(chunk.pair_row[k]);
    margin_ = std::max(margin_, margin);
  }
}

void CellCollector::prove_again() {
  margin_ = 0;
  std::erase_if(beyond_, [&](std::uint32_t row) {
    const std::uint32_t rank = rank_of_row(row);
    const double margin = proof_->margin_for(rank, clearance_[rank]);
    margin_ = std::max(margin_, margin);
    return margin == 0;
  });
}

std::vector<std::uint32_t> CellCollector::take_beyond() {
  margin_ = 0;
  std::vector<std::uint32_t> rows = std::exchange(beyond_, {});
  std::erase_if(flat_, [&](std::uint32_t row) { return std::binary_search(rows.begin(), rows.end(), row); });
  std::vector<std::uint32_t> ranks;
  for (const std::uint32_t row : rows) {
    ranks.push_back(rank_of_row(row));
    if (collects_walls()) walls_.discard(row);
  }
  geometry_.discard(ranks);
  return rows;
}

void CellCollector::keep_wall_memory() {
  WallRows::Memory memory = std::move(walls_).release();
  std::size_t bytes = 0;
  for (const auto& words : memory) bytes += words.bytes();
  if (workspace_.keeps_walls || bytes <= kept_bytes) workspace_.walls = std::move(memory);
}

void CellCollector::place_centroids(Measures& measures) const {
  const auto d = static_cast<std::size_t>(measures.dimension);
  for (std::uint32_t row = 0; row < row_count(); ++row) {
    if (placement_->is_inside(rank_of_row(row))) continue;
    const std::array<double, 3> offset = placement_->offset(rank_of_row(row));
    for (std::size_t c = 0; c < d; ++c) measures.centroid[row_seeds().input[row] * d + c] += offset[c];
  }
}

std::vector<CoincidentWall> CellCollector::coincident_walls(const std::vector<SeedStatus>& status) const {
  std::vector<CoincidentWall> walls;
  const std::vector<std::uint32_t>& seed = active_.seeds().input;
  for (const SolidCells::Coincidence& c : plan_.solid->coincidences)
    if (status[seed[c.rank]] == SeedStatus::ok && status[seed[c.neighbor]] == SeedStatus::ok)
      walls.push_back({seed[c.rank], seed[c.neighbor], c.triangle});
  return walls;
}

Measures CellCollector::finish_measures(Clipped& results, std::vector<CellAtBoundary>& at_boundary) {
  const SeedSet& seeds = row_seeds();
  std::vector<std::uint32_t> outside;
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
  if (results.flat.empty() && plan_.unrestricted)
    results.unclear = classify_unrestricted_cells(setup_, seeds, plan_.pairs, measures);
  return measures;
}

std::optional<Adjacency> CellCollector::finish_adjacency(const std::vector<SeedStatus>& status) {
  if (!want_.adjacency) return {};
  const SeedSet& seeds = row_seeds();
  const double unit = setup_.on_device.frame().unit(setup_.domain.cell_dimension() - 1);
  const double negligible = setup_.exact()     ? 0
                            : setup_.float32() ? NEGLIGIBLE_WALL_FLOAT
                                               : NEGLIGIBLE_WALL_DOUBLE;
  const Placement* const placement = placement_ ? &*placement_ : nullptr;
  if (plan_.selected)
    return walls_.finish_selected(active_.seeds(), {plan_.selected->rank, seeds.input, placement}, status,
                                  unit, want_.walls);
  if (placement) return walls_.finish(*placement, status, unit, negligible);
  return walls_.finish(seeds, status, unit, negligible);
}

Clipped CellCollector::finish() {
  Clipped results;
  std::vector<CellAtBoundary> at_boundary;
  Measures measures = finish_measures(results, at_boundary);
  if (results.flat.empty() && results.unclear.empty()) {
    results.adjacency = finish_adjacency(measures.status);
    if (want_.cells && plan_.solid)
      results.solid = join_solid({setup_.domain, geometry_.finish(measures.status, row_seeds()), at_boundary,
                                  coincident_walls(measures.status), row_seeds(), setup_.on_device.frame(),
                                  measures.status});
    else if (want_.cells)
      results.cells =
          geometry_.finish(measures.status, row_seeds(), plan_.selected ? &plan_.selected->rank : nullptr);
    if (placement_) place_centroids(measures);
    if (want_.reach) {
      reach_.resize(row_seeds().input_count);
      results.reach = std::move(reach_);
    }
    for (const std::uint32_t row : beyond_) results.unproved.push_back(row_seeds().input[row]);
    std::sort(results.unproved.begin(), results.unproved.end());
    results.measures = std::move(measures);
  }
  keep_wall_memory();
  return results;
}

}  // namespace powercell
