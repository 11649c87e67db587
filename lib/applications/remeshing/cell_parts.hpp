/// \file
/// The connected components of cells on a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/applications/remeshing/local_diagram.hpp"

namespace powercell::remeshing {

/// Components of pieces that are connected across edges of the surface.
struct CellParts {
  std::vector<std::uint32_t> part;  ///< per piece index: its component; `nothing` for unused indices
  std::vector<std::uint32_t> seed;  ///< per component
  std::vector<int> euler;           ///< per component: Euler characteristic (63), 1 for a disc
};

CellParts cell_parts(const LocalDiagram& diagram);

}  // namespace powercell::remeshing
