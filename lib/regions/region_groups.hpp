/// \file
/// A tree over the regions: a compact order, and bounding boxes of consecutive groups.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// Group g of level l holds the regions order[g 8^l .. (g+1) 8^l), which lie close together.
struct RegionGroups {
  static constexpr std::size_t fan = 8;
  /// The boxes of one level, rows of dimension coordinates.
  struct Boxes {
    std::vector<double> low, high;
  };
  std::vector<std::uint32_t> order;
  std::vector<Boxes> level;  ///< level 0: the regions; last level: a single group

  RegionGroups(const RegionMesh& mesh, int threads);
};

}  // namespace powercell
