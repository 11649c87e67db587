#include "lib/diagram/clip_plan.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"
#include "lib/clip/unrestricted_cells.hpp"
#include "lib/diagram/chunk_pipeline.hpp"
#include "lib/diagram/stopwatch.hpp"
#include "lib/neighbors/tree_candidates.hpp"
#ifdef POWERCELL_HAS_FLANN
#include "lib/neighbors/list_candidates.hpp"
#endif

namespace powercell {
namespace {

/// With more pieces per cell it is faster to clip unrestricted cells first (docs/performance.md); with few
/// pairs too, because the programs that it takes are those of the measures.
constexpr std::size_t pieces_that_pay = 3, few_pairs = 5000;

/// Shares of a pass, as measured for volumes: the search at the boundary, unrestricted cells, and the pairs.
constexpr double boundary_done = 0.05, cells_done = 0.2, pairs_done = 0.3;

/// Lists from FLANN, or null if the tree is to be searched.
std::unique_ptr<Candidates> make_lists([[maybe_unused]] const DiagramSetup& setup,
                                       [[maybe_unused]] const Scene& scene) {
#ifdef POWERCELL_HAS_FLANN
  if (setup.neighbors == Neighbors::flann) return std::make_unique<ListCandidates>(scene, setup.options);
#endif
  return nullptr;
}

std::unique_ptr<Candidates> by_walls(TreeCandidates tree, const CellWalls& walls) {
  return std::make_unique<CellCandidates>(std::move(tree), walls.offset, walls.neighbor);
}

/// Clips the unrestricted cells that may meet the boundary first. Their walls determine the regions that each
/// is then cut by. All other cells stay unrestricted.
ClipPlan plan_by_cells(const DiagramSetup& setup, const ActiveSeeds& active, Timings& timings) {
  const Scene scene = active.scene();
  ClipPlan plan;
  plan.unrestricted = true;
  setup.progress->begin_part(0, boundary_done);
  const Stopwatch boundary_watch(setup.device);
  const std::vector<std::uint32_t> boundary =
      setup.pairs.at_boundary(active.seeds(), active.tree(), active.by_region, setup.options.progress);
  timings.pairs = boundary_watch.seconds();

  setup.progress->begin_part(boundary_done, cells_done);
  const Stopwatch cell_watch(setup.device);
  std::unique_ptr<Candidates> lists = make_lists(setup, scene);
  std::optional<TreeCandidates> tree;
  if (!lists) tree.emplace(scene);
  const CellWalls walls =
      clip_unrestricted_cells(scene, lists ? *lists : *tree, boundary, setup.options.progress);
  timings.neighbors = cell_watch.seconds();

  setup.progress->begin_part(cells_done, pairs_done);
  const Stopwatch pair_watch(setup.device);
  plan.pairs = setup.pairs.by_cells(active.seeds(), boundary, walls, setup.options.progress);
  timings.pairs += pair_watch.seconds();
  plan.candidates = lists ? std::move(lists) : by_walls(std::move(*tree), walls);
  return plan;
}

/// The pairs of cells that are neither in `solid` nor cut by regions: each is clipped as a whole.
Pairs whole_cells(const DiagramSetup& setup, const ActiveSeeds& active, const std::vector<bool>& excluded) {
  Pairs pairs;
  pairs.offset.push_back(0);
  for (std::uint32_t rank = 0; rank < active.seeds().size(); ++rank) {
    if (!excluded[rank]) pairs.region.push_back(static_cast<std::uint32_t>(setup.domain.region_count()));
    pairs.offset.push_back(pairs.region.size());
  }
  return pairs;
}

/// The pairs with regions of the ranks `by_region`, ascending, and those with the container of all others but
/// the excluded ones.
Pairs with_regions(const DiagramSetup& setup, const ActiveSeeds& active,
                   const std::vector<std::uint32_t>& by_region, const std::vector<bool>& excluded,
                   const CellWalls& walls) {
  const Pairs all = setup.pairs.by_cells(active.seeds(), by_region, walls);
  Pairs pairs;
  pairs.offset.push_back(0);
  for (std::uint32_t rank = 0; rank < active.seeds().size(); ++rank) {
    if (!excluded[rank])
      pairs.region.insert(pairs.region.end(),
                          all.region.begin() + static_cast<std::ptrdiff_t>(all.offset[rank]),
                          all.region.begin() + static_cast<std::ptrdiff_t>(all.offset[rank + 1]));
    pairs.offset.push_back(pairs.region.size());
  }
  return pairs;
}

/// Computes the cells at the boundary from it. All other cells stay whole, but for those that are clipped
/// region by region because rounding leaves something open.
/// \param faces  whether to make the surfaces of the cells at the boundary
ClipPlan plan_by_boundary(const DiagramSetup& setup, const ActiveSeeds& active, bool faces,
                          Workspace& workspace, Timings& timings) {
  const Scene scene = active.scene();
  const SolidBoundary& boundary = *setup.boundary;
  ClipPlan plan;
  setup.progress->begin_part(0, boundary_done);
  const Stopwatch pair_watch(setup.device);
  Pairs on_facets = boundary.pairs.by_regions(active.seeds(), active.tree(), setup.options.progress);
  timings.pairs = pair_watch.seconds();
  timings.pair_count = on_facets.region.size();

  setup.progress->begin_part(boundary_done, pairs_done);
  const Stopwatch cell_watch(setup.device);
  TreeCandidates tree(scene);
  const Scene facets{boundary.on_device, scene.buffers, scene.seeds, scene.tree};
  RegionCandidates facet_candidates(facets, on_facets.list_offset, on_facets.list_seed, on_facets.all_listed);
  SolidMemory memory{std::exchange(workspace.facets, {}), std::exchange(workspace.devices[0].clip[0], {})};
  plan.solid = compute_solid_cells(
      {setup.domain.mesh(), boundary, scene, on_facets, active.by_region, facet_candidates, tree,
       chunk_pairs(setup, setup.members.front(), on_facets.region.size()), faces, setup.threads,
       setup.options.progress},
      memory, plan.solid_statistics);
  workspace.devices[0].clip[0] = std::move(memory.cells);  // clipping goes on with them
  if (memory.facets && memory.facets->bytes() <= kept_bytes) workspace.facets = std::move(memory.facets);
  std::vector<bool> excluded(active.seeds().size());
  for (const SolidCells::Cell& cell : plan.solid->cells) excluded[cell.rank] = true;
  for (const SolidCells::UniformCell& cell : plan.solid->uniform) excluded[cell.rank] = true;
  for (const std::uint32_t rank : plan.solid->flat) excluded[rank] = true;
  std::vector<std::uint32_t> by_region = plan.solid->unclear;
  by_region.insert(by_region.end(), active.by_region.begin(), active.by_region.end());
  std::sort(by_region.begin(), by_region.end());
  by_region.erase(std::unique(by_region.begin(), by_region.end()), by_region.end());
  if (by_region.empty() || setup.domain.is_solid()) {
    plan.pairs = whole_cells(setup, active, excluded);
    plan.candidates = std::make_unique<TreeCandidates>(std::move(tree));
  } else {
    const CellWalls walls = clip_unrestricted_cells(scene, tree, by_region);
    plan.pairs = with_regions(setup, active, by_region, excluded, walls);
    plan.candidates = by_walls(std::move(tree), walls);
  }
  timings.neighbors = cell_watch.seconds();
  return plan;
}

/// The ranks that have pairs.
std::vector<std::uint32_t> ranks_of(const Pairs& pairs) {
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t rank = 0; rank + 1 < pairs.offset.size(); ++rank)
    if (pairs.offset[rank + 1] > pairs.offset[rank]) ranks.push_back(rank);
  return ranks;
}

/// The search of all seeds, which does not depend on the pairs.
std::unique_ptr<Candidates> kept_search(const Scene& scene, Workspace& workspace) {
  if (workspace.search) return std::move(workspace.search);
  return std::make_unique<TreeCandidates>(scene);
}

std::unique_ptr<Candidates> candidates_by_regions(const DiagramSetup& setup, const Scene& scene,
                                                  const Pairs& pairs, Workspace& workspace) {
  if (std::unique_ptr<Candidates> lists = make_lists(setup, scene)) return lists;
  if (setup.domain.region_count() == 1) return kept_search(scene, workspace);
  if (setup.has_inside) {
    const std::vector<std::uint32_t> ranks = ranks_of(pairs);
    if (pairs.region.size() > pieces_that_pay * ranks.size() || pairs.region.size() <= few_pairs) {
      TreeCandidates tree(scene);
      const CellWalls walls = clip_unrestricted_cells(scene, tree, ranks, setup.options.progress);
      return by_walls(std::move(tree), walls);
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

ClipPlan plan_by_regions(const DiagramSetup& setup, const ActiveSeeds& active, Workspace& workspace,
                         Timings& timings) {
  ClipPlan plan;
  setup.progress->begin_part(0, cells_done);
  const Stopwatch pair_watch(setup.device);
  plan.pairs = active.images()
                   ? one_pair_each(active.images()->own)
                   : setup.pairs.by_regions(active.seeds(), active.tree(), setup.options.progress);
  timings.pairs = pair_watch.seconds();
  setup.progress->begin_part(cells_done, pairs_done);
  const Stopwatch neighbor_watch(setup.device);
  plan.candidates = candidates_by_regions(setup, active.scene(), plan.pairs, workspace);
  plan.pairs.list_offset = {};  // the device has them now
  plan.pairs.list_seed = {};
  timings.neighbors = neighbor_watch.seconds();
  return plan;
}

/// The pairs of `rank` alone, row by row.
Pairs pairs_of(const Pairs& all, const std::vector<std::uint32_t>& rank) {
  Pairs pairs;
  pairs.offset.push_back(0);
  for (const std::uint32_t r : rank) {
    pairs.region.insert(pairs.region.end(), all.region.begin() + static_cast<std::ptrdiff_t>(all.offset[r]),
                        all.region.begin() + static_cast<std::ptrdiff_t>(all.offset[r + 1]));
    pairs.offset.push_back(pairs.region.size());
  }
  return pairs;
}

/// Clips the selected cells alone: as wholes first where the domain has an inside, and then in the regions
/// that these meet. On a surface, whose regions are searched for seeds, all pairs are found.
ClipPlan plan_by_selection(const DiagramSetup& setup, const ActiveSeeds& active, const Selection& selection,
                           Workspace& workspace, Timings& timings) {
  const Scene scene = active.scene();
  const SeedSet& seeds = active.seeds();
  ClipPlan plan;
  plan.selected = make_rows(selection, seeds,
                            active.images() ? active.images()->own : static_cast<std::uint32_t>(seeds.size()),
                            setup.threads);
  const std::vector<std::uint32_t>& rank = plan.selected->rank;
  setup.progress->begin_part(0, pairs_done);
  const Stopwatch watch(setup.device);
  plan.candidates = make_lists(setup, scene);
  if (active.images() || setup.domain.region_count() == 1) {
    plan.pairs = one_pair_each(static_cast<std::uint32_t>(rank.size()));
    if (!plan.candidates) plan.candidates = kept_search(scene, workspace);
  } else if (setup.has_inside) {
    std::optional<TreeCandidates> tree;
    if (!plan.candidates) tree.emplace(scene);
    const CellWalls walls = clip_unrestricted_cells(
        scene, tree ? static_cast<Candidates&>(*tree) : *plan.candidates, rank, setup.options.progress);
    plan.pairs = pairs_of(setup.pairs.by_cells(seeds, rank, walls), rank);
    if (tree) plan.candidates = by_walls(std::move(*tree), walls);
  } else {
    const Pairs all = setup.pairs.by_regions(seeds, active.tree(), setup.options.progress);
    plan.pairs = pairs_of(all, rank);
    if (!plan.candidates)
      plan.candidates =
          std::make_unique<RegionCandidates>(scene, all.list_offset, all.list_seed, all.all_listed);
  }
  timings.pairs = watch.seconds();
  return plan;
}

}  // namespace

std::unique_ptr<Candidates> search_all(const DiagramSetup& setup, const Scene& scene) {
  if (std::unique_ptr<Candidates> lists = make_lists(setup, scene)) return lists;
  return std::make_unique<TreeCandidates>(scene);
}

ClipPlan make_plan(const DiagramSetup& setup, const ActiveSeeds& active, PlanKind kind,
                   const Selection* selection, Workspace& workspace, Timings& timings) {
  timings.pair_count = 0;
  if (active.seeds().size() == 0) return {};
  const bool along_regions = kind == PlanKind::geometry && !setup.domain.is_solid();
  ClipPlan plan = [&] {
    if (selection) return plan_by_selection(setup, active, *selection, workspace, timings);
    // Surfaces, where no cell lies inside; one convex region; the pieces of cells that a caller asks for.
    if (!setup.has_inside || along_regions) return plan_by_regions(setup, active, workspace, timings);
    // Volumes: whole cells, and the triangles of the boundary.
    if (setup.boundary)
      return plan_by_boundary(setup, active, kind == PlanKind::geometry, workspace, timings);
    // Polygons, and volumes that the boundary alone does not decide: whole cells, and pieces at the boundary.
    return plan_by_cells(setup, active, timings);
  }();
  plan.seeds = active.seeds().size();
  setup.progress->begin_part(pairs_done, 1);
  timings.pair_count += plan.pairs.region.size();
  return plan;
}

}  // namespace powercell
