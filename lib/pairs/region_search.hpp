/// \file
/// Finds the candidates of all regions, in parallel. Internal.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lib/pairs/pair_finder.hpp"
#include "lib/regions/region_groups.hpp"

namespace powercell::pairs {

/// Everything must outlive the search.
struct RegionSearchInput {
  const RegionMesh& mesh;
  const RegionGroups& groups;
  const SeedSet& seeds;
  const PackedTree& tree;
  int threads;
  const std::function<bool(double)>& progress;
};

/// A view of the candidate ranks of one region, ascending.
struct RankList {
  const std::uint32_t* first = nullptr;
  std::uint32_t count = 0;
};

/// The candidates found. The lists point into `tasks`.
struct RegionLists {
  struct Task {
    std::vector<std::uint32_t> ranks;  ///< region after region in the order of the groups
    std::vector<std::uint64_t> end;    ///< per region: end of its ranks
  };
  std::vector<Task> tasks;
  std::vector<RankList> list;  ///< by region
};

/// \throw Error interrupted
RegionLists search_regions(const RegionSearchInput& search);

}  // namespace powercell::pairs
