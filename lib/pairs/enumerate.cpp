#include "lib/pairs/enumerate.hpp"

#include <algorithm>
#include <numeric>

#include "lib/base/threads.hpp"
#include "lib/domain/outline.hpp"
#include "lib/pairs/boundary_planes.hpp"
#include "lib/pairs/cell_search.hpp"
#include "lib/pairs/region_search.hpp"
#include "lib/regions/region_blocks.hpp"
#include "lib/regions/region_locator.hpp"

namespace powercell {
namespace {

using namespace pairs;

/// Longer lists cost more than a search in the tree of the seeds (LISTED_SEEDS in
/// kernels/neighbors/region.cl).
constexpr std::uint32_t most_listed = 96;

/// One region meets them all, as far as anybody can tell more cheaply than by clipping.
Pairs all_with_one_region(std::size_t seeds) {
  Pairs pairs;
  pairs.offset.resize(seeds + 1);
  std::iota(pairs.offset.begin(), pairs.offset.end(), std::uint64_t{0});
  pairs.region.assign(seeds, 0);
  return pairs;
}

void keep_short_lists(const std::vector<RankList>& lists, Pairs& pairs) {
  const auto kept = [](const RankList& list) { return list.count <= most_listed ? list.count : 0; };
  pairs.list_offset.assign(1, 0);
  for (const RankList& list : lists) pairs.list_offset.push_back(pairs.list_offset.back() + kept(list));
  pairs.list_seed.reserve(pairs.list_offset.back());
  for (const RankList& list : lists)
    pairs.list_seed.insert(pairs.list_seed.end(), list.first, list.first + kept(list));
}

}  // namespace

PairFinder::PairFinder(const RegionMesh& mesh, int threads)
    : mesh_(mesh), threads_(thread_count(threads)), groups_(std::make_unique<RegionGroups>(mesh, threads_)) {}
PairFinder::~PairFinder() = default;
PairFinder::PairFinder(PairFinder&&) noexcept = default;

const RegionBlocks& PairFinder::blocks() {
  if (!blocks_) blocks_ = std::make_unique<RegionBlocks>(mesh_, *groups_);
  return *blocks_;
}

RegionLocator PairFinder::locator() {
  return {mesh_, *groups_, blocks()};
}

Pairs PairFinder::all(const SeedSet& seeds, const PackedTree& tree,
                      const std::function<bool(double)>& progress) const {
  if (mesh_.region_count() == 1) return all_with_one_region(seeds.size());
  const RegionLists found = search_regions({mesh_, *groups_, seeds, tree, threads_, progress});
  Pairs pairs = transpose(found.list, seeds.size(), threads_);
  keep_short_lists(found.list, pairs);
  pairs.all_listed = pairs.list_seed.size() == pairs.region.size();
  return pairs;
}

BoundaryRanks PairFinder::at_boundary(const SeedSet& seeds, const PackedTree& tree,
                                      std::span<const std::uint32_t> by_region,
                                      const std::function<bool(double)>& progress) {
  if (!boundary_) {
    boundary_ = std::make_unique<RegionMesh>(boundary_of(mesh_));
    boundary_groups_ = std::make_unique<RegionGroups>(*boundary_, threads_);
  }
  std::vector<bool> marked(seeds.size());
  for (const std::uint32_t rank : by_region) marked[rank] = true;
  std::function<bool(double)> asked;
  if (progress) asked = [&](double) { return progress(0); };
  const RegionLists found = search_regions({*boundary_, *boundary_groups_, seeds, tree, threads_, asked});
  for (const RankList& list : found.list)
    for (std::uint32_t k = 0; k < list.count; ++k) marked[list.first[k]] = true;
  BoundaryRanks all;
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank)
    if (marked[rank]) all.ranks.push_back(rank);
  all.by_region.assign(by_region.begin(), by_region.end());
  std::sort(all.by_region.begin(), all.by_region.end());
  return all;
}

Pairs PairFinder::of_cells(const SeedSet& seeds, const BoundaryRanks& ranks, const CellWalls& walls,
                           bool planes, const std::function<bool(double)>& progress) {
  planes = planes && boundary_ && mesh_.shape == RegionShape::tetrahedron;
  if (planes && !planes_) planes_ = std::make_unique<BoundaryPlanes>(*boundary_, *boundary_groups_);
  return search_cells(
      {mesh_, *groups_, blocks(), planes ? planes_.get() : nullptr, seeds, ranks, walls, threads_, progress});
}

std::vector<std::uint32_t> PairFinder::regions_of(const SeedSet& seeds, std::uint32_t rank,
                                                  const CellWalls& walls) const {
  CellHull hull;
  hull.set(walls, rank);
  std::vector<std::uint32_t> regions;
  CellSearch(mesh_, *groups_, *blocks_, seeds, walls).find(rank, hull, regions);
  return regions;
}

Pairs PairFinder::with_whole_cells(const SeedSet& seeds, const PackedTree& tree,
                                   std::span<const std::uint32_t> not_whole,
                                   const std::function<bool(double)>& progress) {
  if (!has_inside(mesh_)) return all(seeds, tree, progress);
  SeedMarks wanted(seeds.size()), whole(seeds.size());
  for (const std::uint32_t rank : at_boundary(seeds, tree, not_whole, progress).ranks) wanted.set(rank);

  const RegionLists found =
      search_regions({mesh_, *groups_, seeds, tree, threads_, progress}, &wanted, &whole);
  std::vector<std::uint32_t> whole_ranks, wanted_ranks;
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank)
    if (whole[rank]) whole_ranks.push_back(rank);
  std::vector<std::uint64_t> end;
  for (const RankList& list : found.list) {
    std::copy_if(list.first, list.first + list.count, std::back_inserter(wanted_ranks),
                 [&](std::uint32_t rank) { return wanted[rank]; });
    end.push_back(wanted_ranks.size());
  }
  std::vector<RankList> lists;
  for (std::size_t r = 0; r < end.size(); ++r) {
    const std::uint64_t begin = r == 0 ? 0 : end[r - 1];
    lists.push_back({wanted_ranks.data() + begin, static_cast<std::uint32_t>(end[r] - begin)});
  }
  lists.push_back({whole_ranks.data(), static_cast<std::uint32_t>(whole_ranks.size())});
  Pairs pairs = transpose(lists, seeds.size(), threads_);
  keep_short_lists(found.list, pairs);
  return pairs;
}

Pairs enumerate_pairs(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, int threads,
                      const std::function<bool(double)>& progress) {
  return PairFinder(mesh, threads).all(seeds, tree, progress);
}

}  // namespace powercell
