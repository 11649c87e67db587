/// \file
/// The candidates of all regions, in parallel. Internal.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <vector>

#include "lib/pairs/enumerate.hpp"
#include "lib/pairs/transpose.hpp"
#include "lib/regions/region_groups.hpp"

namespace powercell::pairs {

/// What a search is about; references to what outlives it.
struct RegionSearch {
  const RegionMesh& mesh;
  const RegionGroups& groups;
  const SeedSet& seeds;
  const PackedTree& tree;
  int threads;
  const std::function<bool(double)>& progress;
};

/// A flag for each seed, set by several threads.
class SeedMarks {
 public:
  explicit SeedMarks(std::size_t seeds) : mark_(seeds) {}
  void set(std::uint32_t rank) { mark_[rank].store(true, std::memory_order_relaxed); }
  bool operator[](std::uint32_t rank) const { return mark_[rank].load(std::memory_order_relaxed); }
  std::size_t size() const { return mark_.size(); }

 private:
  std::vector<std::atomic<bool>> mark_;
};

/// The candidates found; lists point into memory of the struct.
struct RegionLists {
  struct Task {
    std::vector<std::uint32_t> ranks;  ///< region after region in the order of the groups
    std::vector<std::uint64_t> end;    ///< per region: end of its ranks
  };
  std::vector<Task> tasks;
  std::vector<RankList> list;  ///< by region
};

/// The candidates of every region. With `wanted`, regions of which no seed is wanted may get none: then their
/// seeds are marked in `other`, and so is each seed of a list that is not wanted.
RegionLists search_regions(const RegionSearch& search, const SeedMarks* wanted = nullptr,
                           SeedMarks* other = nullptr);

}  // namespace powercell::pairs
