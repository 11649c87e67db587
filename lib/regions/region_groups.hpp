/// \file
/// Regions in a compact order, and boxes of groups of consecutive ones. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// Group g of level l holds the regions order[g 8^l .. (g+1) 8^l): what is near one of them is near all.
struct RegionGroups {
  static constexpr std::size_t fan = 8;
  /// The boxes of one level, rows of dimension coordinates.
  struct Boxes {
    std::vector<double> low, high;
  };
  std::vector<std::uint32_t> order;
  std::vector<Boxes> level;  ///< level 0 are the regions; the last level is one group

  RegionGroups(const RegionMesh& mesh, int threads);
};

}  // namespace powercell
