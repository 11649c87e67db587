#include "lib/diagram/plan.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"
#include "lib/clip/unrestricted_cells.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#ifdef POWERCELL_HAS_FLANN
#include "lib/neighbors/list_candidates.hpp"
#endif

namespace powercell {
namespace {

/// With more pieces per cell it is faster to clip unrestricted cells first (docs/performance.md).
constexpr std::size_t pieces_that_pay = 3;

/// Shares of a pass, as measured for volumes: the search at the boundary, unrestricted cells, and the pairs.
constexpr double boundary_done = 0.05, cells_done = 0.2, pairs_done = 0.3;

/// Lists from FLANN, or null if the tree is to be searched.
std::unique_ptr<Candidates> make_lists([[maybe_unused]] const Setup& setup,
                                       [[maybe_unused]] const Scene& scene) {
#ifdef POWERCELL_HAS_FLANN
  if (setup.neighbors == Neighbors::flann) return std::make_unique<ListCandidates>(scene, setup.options);
#endif
  return nullptr;
}

/// Clips the unrestricted cells that may meet the boundary first. Their walls determine the regions that each
/// is then cut by, or planes of the boundary if the domain is convex around the cell. All other cells stay
/// unrestricted.
Plan plan_by_cells(const Setup& setup, const Active& active, Timings& timings) {
  const Scene scene = active.scene();
  Plan plan;
  plan.unrestricted = true;
  setup.progress->begin_part(0, boundary_done);
  const Stopwatch boundary_watch(setup.device);
  const BoundaryRanks boundary =
      setup.pairs.at_boundary(active.seeds(), active.tree(), active.by_region, setup.options.progress);
  timings.pairs = boundary_watch.seconds();

  setup.progress->begin_part(boundary_done, cells_done);
  const Stopwatch cell_watch(setup.device);
  std::unique_ptr<Candidates> lists = make_lists(setup, scene);
  std::optional<TreeCandidates> tree;
  if (!lists) tree.emplace(scene);
  plan.walls = clip_unrestricted_cells(scene, lists ? *lists : *tree, boundary.ranks, setup.options.progress);
  timings.neighbors = cell_watch.seconds();

  setup.progress->begin_part(cells_done, pairs_done);
  const Stopwatch pair_watch(setup.device);
  const bool planes = tree && !setup.float32() && active.seeds().size() < BORDER_PLANE;
  plan.pairs = setup.pairs.by_cells(active.seeds(), boundary, plan.walls, planes, setup.options.progress);
  timings.pairs += pair_watch.seconds();
  plan.candidates = lists ? std::move(lists)
                          : std::make_unique<CellCandidates>(std::move(*tree), plan.walls, plan.pairs.planes);
  if (plan.pairs.planes.rank.empty()) plan.walls = {};
  return plan;
}

/// The ranks that have pairs.
std::vector<std::uint32_t> ranks_of(const Pairs& pairs) {
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t rank = 0; rank + 1 < pairs.offset.size(); ++rank)
    if (pairs.offset[rank + 1] > pairs.offset[rank]) ranks.push_back(rank);
  return ranks;
}

std::unique_ptr<Candidates> candidates_by_regions(const Setup& setup, const Scene& scene,
                                                  const Pairs& pairs) {
  if (std::unique_ptr<Candidates> lists = make_lists(setup, scene)) return lists;
  if (setup.domain.region_count() == 1) return std::make_unique<TreeCandidates>(scene);
  if (setup.has_inside) {
    const std::vector<std::uint32_t> ranks = ranks_of(pairs);
    if (pairs.region.size() > pieces_that_pay * ranks.size()) {
      TreeCandidates tree(scene);
      const CellWalls walls = clip_unrestricted_cells(scene, tree, ranks, setup.options.progress);
      return std::make_unique<CellCandidates>(std::move(tree), walls, CellPlanes{});
    }
  }
  return std::make_unique<RegionCandidates>(scene, pairs.list_offset, pairs.list_seed, pairs.all_listed);
}

/// The pairs of the first `count` ranks with the only region.
Pairs one_pair_each(std::uint32_t count) {
  Pairs pairs;
  pairs.offset.resize(std::size_t{count} + 1);
  std::iota(pairs.offset.begin(), pairs.offset.end(), std::uint64_t{0});
  pairs.region.resize(count);
  return pairs;
}

Plan plan_by_regions(const Setup& setup, const Active& active, Timings& timings) {
  Plan plan;
  setup.progress->begin_part(0, cells_done);
  const Stopwatch pair_watch(setup.device);
  plan.pairs = active.images()
                   ? one_pair_each(active.images()->own)
                   : setup.pairs.by_regions(active.seeds(), active.tree(), setup.options.progress);
  timings.pairs = pair_watch.seconds();
  setup.progress->begin_part(cells_done, pairs_done);
  const Stopwatch neighbor_watch(setup.device);
  plan.candidates = candidates_by_regions(setup, active.scene(), plan.pairs);
  plan.pairs.list_offset = {};  // the device has them now
  plan.pairs.list_seed = {};
  timings.neighbors = neighbor_watch.seconds();
  return plan;
}

}  // namespace

Plan make_plan(const Setup& setup, const Active& active, PlanKind kind, Timings& timings) {
  if (active.seeds().size() == 0) return {};
  Plan plan = kind == PlanKind::integrals && setup.has_inside ? plan_by_cells(setup, active, timings)
                                                              : plan_by_regions(setup, active, timings);
  setup.progress->begin_part(pairs_done, 1);
  timings.pair_count = plan.pairs.region.size();
  return plan;
}

std::vector<SplitPair> Plan::split(const Setup& setup, const Active& active,
                                   std::span<const std::uint32_t> pair_seed,
                                   std::span<const std::uint32_t> pair_region,
                                   std::span<const std::uint32_t> for_host) const {
  std::vector<SplitPair> found;
  const std::vector<std::uint32_t>& cut = pairs.planes.rank;
  for (const std::uint32_t pair : for_host)
    if (pair_region[pair] == setup.domain.region_count() &&
        std::binary_search(cut.begin(), cut.end(), pair_seed[pair]))
      found.push_back({pair, {}});
  parallel_for(setup.threads, found.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      found[k].regions = setup.pairs.regions_of(active.seeds(), pair_seed[found[k].pair], walls);
  });
  return found;
}

}  // namespace powercell
