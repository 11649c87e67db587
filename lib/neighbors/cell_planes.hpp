/// \file
/// Planes of the boundary of the domain that cut cells (docs/mathematics.md, "Cells at the boundary").
/// Internal.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace powercell {

/// A plane through a facet, relative to a seed: the domain is where normal . y <= height.
struct LocalPlane {
  std::array<double, 3> normal;  ///< of unit length
  double height;
  double error;  ///< the plane is this near to the true one within the cell
};

/// Of cells that are cut by planes instead of the regions of the domain.
struct CellPlanes {
  std::vector<std::uint32_t> rank;  ///< ascending
  std::vector<std::uint64_t> end;   ///< per rank: end of its planes
  std::vector<LocalPlane> plane;
};

}  // namespace powercell
