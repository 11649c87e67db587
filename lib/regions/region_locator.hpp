/// \file
/// Point location among the regions.
#pragma once

#include <array>

#include "lib/domain/region_mesh.hpp"
#include "lib/regions/region_blocks.hpp"

namespace powercell {

/// Keeps references. Thread-safe.
/// \pre the regions are convex polygons in the plane or tetrahedra
class RegionLocator {
 public:
  RegionLocator(const RegionMesh& mesh, const RegionGroups& groups, const RegionBlocks& blocks)
      : mesh_(mesh), groups_(groups), blocks_(blocks) {}

  static constexpr int unclear = -1;
  /// The number of regions whose interior contains x (two coordinates in the plane), or `unclear` if x is
  /// within rounding of the border of a region.
  int regions_at(const std::array<double, 3>& x) const;

 private:
  enum class Side { inside, outside, unclear };
  Side side_of(std::uint32_t region, const std::array<double, 3>& x) const;
  /// Adds to `found` the regions of a group that contain x. Returns true if x is within rounding of a border.
  bool count_below(std::size_t level, std::size_t group, const std::array<double, 3>& x, int& found) const;

  const RegionMesh& mesh_;
  const RegionGroups& groups_;
  const RegionBlocks& blocks_;
};

}  // namespace powercell
