#include "lib/pairs/pair_finder.hpp"

#include <algorithm>
#include <numeric>

#include "lib/base/threads.hpp"
#include "lib/domain/outline.hpp"
#include "lib/pairs/candidate_search.hpp"
#include "lib/pairs/cell_search.hpp"

namespace powercell {
namespace {

using namespace pairs;

/// The tree of the seeds is searched faster than a longer list (LISTED_SEEDS in kernels/neighbors/region.cl).
constexpr std::uint32_t most_listed = 96;

/// Pairs every seed with the only region: clipping decides which cells meet it.
Pairs all_with_one_region(std::size_t seeds) {
  Pairs pairs;
  pairs.offset.resize(seeds + 1);
  std::iota(pairs.offset.begin(), pairs.offset.end(), std::uint64_t{0});
  pairs.region.assign(seeds, 0);
  return pairs;
}

/// The bounds of `parts` consecutive ranges of regions with about equal numbers of pairs.
std::vector<std::size_t> balanced(const std::vector<RankList>& lists, std::uint64_t total,
                                  std::size_t parts) {
  std::vector<std::size_t> bound{0};
  std::uint64_t sum = 0;
  for (std::size_t r = 0; r < lists.size(); ++r) {
    if (sum * parts >= total * bound.size() && bound.size() < parts) bound.push_back(r);
    sum += lists[r].count;
  }
  bound.resize(parts, lists.size());
  bound.push_back(lists.size());
  return bound;
}

/// Turns the seeds of each region into the regions of each seed.
/// \param lists  by region
/// \param seeds  number of ranks
Pairs transpose(const std::vector<RankList>& lists, std::size_t seeds, int threads) {
  std::uint64_t total = 0;
  for (const RankList& list : lists) total += list.count;
  threads = threads_for(total, threads);
  // A counting sort, in parts with counters of their own. The number of parts keeps the counters linear in
  // the output.
  const std::size_t parts = static_cast<std::size_t>(
      std::clamp<std::uint64_t>(total / std::max<std::size_t>(seeds, 1), 1, static_cast<unsigned>(threads)));
  const std::vector<std::size_t> bound = balanced(lists, total, parts);
  std::vector<std::vector<std::uint64_t>> cursor(parts);
  const auto for_pairs = [&](const auto& body) {
    parallel_for(threads, parts, [&](std::size_t begin, std::size_t end) {
      for (std::size_t part = begin; part < end; ++part) {
        cursor[part].resize(seeds);
        for (std::size_t r = bound[part]; r < bound[part + 1]; ++r)
          for (std::uint32_t k = 0; k < lists[r].count; ++k) body(cursor[part][lists[r].first[k]], r);
      }
    });
  };

  for_pairs([](std::uint64_t& count, std::size_t) { ++count; });
  Pairs pairs;
  pairs.offset.resize(seeds + 1);
  std::uint64_t sum = 0;
  for (std::size_t rank = 0; rank < seeds; ++rank) {
    pairs.offset[rank] = sum;
    for (std::vector<std::uint64_t>& c : cursor) {
      const std::uint64_t count = c[rank];
      c[rank] = sum;
      sum += count;
    }
  }
  pairs.offset[seeds] = sum;
  pairs.region.resize(total);
  // Regions ascend within parts and from part to part, so rows ascend.
  for_pairs([&](std::uint64_t& at, std::size_t r) { pairs.region[at++] = static_cast<std::uint32_t>(r); });
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

/// The boundary facets as regions.
struct PairFinder::Boundary {
  RegionMesh mesh;
  RegionGroups groups;

  Boundary(const RegionMesh& domain, int threads) : mesh(boundary_of(domain)), groups(mesh, threads) {}
};

PairFinder::PairFinder(const RegionMesh& mesh, int threads) : mesh_(mesh), threads_(thread_count(threads)) {}
PairFinder::~PairFinder() = default;

const RegionGroups& PairFinder::groups() const {
  if (!groups_)
    groups_ = mesh_.kept.get<RegionGroups>([&] { return std::make_shared<RegionGroups>(mesh_, threads_); });
  return *groups_;
}

const RegionBlocks& PairFinder::blocks() const {
  if (!blocks_)
    blocks_ = mesh_.kept.get<RegionBlocks>([&] { return std::make_shared<RegionBlocks>(mesh_, groups()); });
  return *blocks_;
}

const PairFinder::Boundary& PairFinder::boundary() const {
  if (!boundary_)
    boundary_ = mesh_.kept.get<Boundary>([&] { return std::make_shared<Boundary>(mesh_, threads_); });
  return *boundary_;
}

RegionLocator PairFinder::locator() const {
  return {mesh_, groups(), blocks()};
}

Pairs PairFinder::by_regions(const SeedSet& seeds, const PackedTree& tree,
                             const std::function<bool(double)>& progress) const {
  if (mesh_.region_count() == 1) return all_with_one_region(seeds.size());
  const RegionLists found = search_regions({mesh_, groups(), seeds, tree, threads_, progress});
  Pairs pairs = transpose(found.list, seeds.size(), threads_);
  keep_short_lists(found.list, pairs);
  pairs.all_listed = pairs.list_seed.size() == pairs.region.size();
  return pairs;
}

std::vector<std::uint32_t> PairFinder::at_boundary(const SeedSet& seeds, const PackedTree& tree,
                                                   std::span<const std::uint32_t> by_region,
                                                   const std::function<bool(double)>& progress) const {
  std::vector<bool> marked(seeds.size());
  for (const std::uint32_t rank : by_region) marked[rank] = true;
  std::function<bool(double)> report_start;
  if (progress) report_start = [&](double) { return progress(0); };
  const RegionLists found =
      search_regions({boundary().mesh, boundary().groups, seeds, tree, threads_, report_start});
  for (const RankList& list : found.list)
    for (std::uint32_t k = 0; k < list.count; ++k) marked[list.first[k]] = true;
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank)
    if (marked[rank]) ranks.push_back(rank);
  return ranks;
}

Pairs PairFinder::by_cells(const SeedSet& seeds, std::span<const std::uint32_t> ranks, const CellWalls& walls,
                           const std::function<bool(double)>& progress) const {
  return search_cells({mesh_, groups(), blocks(), seeds, ranks, walls, threads_, progress});
}

}  // namespace powercell
