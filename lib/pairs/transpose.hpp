/// \file
/// From the seeds of each region to the regions of each seed. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/pairs/pair_finder.hpp"

namespace powercell::pairs {

/// The candidate ranks of one region, ascending; memory owned elsewhere.
struct RankList {
  const std::uint32_t* first = nullptr;
  std::uint32_t count = 0;
};

/// \param lists by region   \param seeds number of ranks
Pairs transpose(const std::vector<RankList>& lists, std::size_t seeds, int threads);

}  // namespace powercell::pairs
