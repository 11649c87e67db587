/// \file
/// Groups of regions by blocks of eight, coordinate by coordinate for vector units. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "lib/regions/lanes.hpp"
#include "lib/regions/region_groups.hpp"

namespace powercell {

/// A block holds the members of a group; where these are less than eight the last one fills it up.
struct RegionBlocks {
  int dimension;
  std::vector<std::vector<Lanes>> box;  ///< by level of the members: low, then high coordinates of each block
  std::vector<std::uint64_t> corner_offset;  ///< blocks of regions + 1, into `corner`
  std::vector<Lanes> corner;                 ///< corner after corner; regions of fewer repeat their last one

  RegionBlocks(const RegionMesh& mesh, const RegionGroups& groups);

  const Lanes* boxes(std::size_t level, std::size_t block) const {
    return &box[level][block * 2 * static_cast<std::size_t>(dimension)];
  }
  /// By member of a block of boxes: the largest distance along an axis from the box [low, high], negative
  /// where they overlap. \param low, high  relative to `origin`
  void find_gaps(std::size_t level, std::size_t block, const double* origin, const double* low,
                 const double* high, Lanes& gap) const;
};

}  // namespace powercell
