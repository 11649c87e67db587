/// \file
/// Cells of VTK's two formats, and their conversion.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/io/read/mesh.hpp"

namespace powercell::io {

/// Cells in VTK's representation. `offset` has cells + 1 entries into `connectivity`.
struct VtkCells {
  std::vector<std::int64_t> offset, connectivity;
  std::vector<std::int64_t> type;  ///< VTK's number of the kind of each cell
};

/// Adds the cells to `mesh`: tetrahedra and faces (triangle, quadrilateral, polygon, pixel, strip); points
/// and lines are skipped.
/// \param base  added to each index (for several pieces in a file)
/// \throw Error invalid_file (which cell)
void add_vtk_cells(const VtkCells& cells, std::size_t base, const std::string& name, MeshFile& mesh);

}  // namespace powercell::io
