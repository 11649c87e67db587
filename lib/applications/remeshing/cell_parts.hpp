/// \file
/// The connected parts of cells on a surface.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/applications/remeshing/local_diagram.hpp"

namespace powercell::remeshing {

/// The pieces of each cell joined across the edges of the surface.
struct CellParts {
  std::vector<std::uint32_t> part;  ///< per piece number (also of unused ones): its part
  std::vector<std::uint32_t> seed;  ///< per part
  std::vector<int> euler;           ///< per part: 1 for a disc
};

CellParts cell_parts(const LocalDiagram& diagram);

}  // namespace powercell::remeshing
