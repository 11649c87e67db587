/// \file
/// The elements of an unstructured grid in VTK's arrays.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/io/write/output.hpp"

namespace powercell::io {

/// Polygons (cell_dimension 2) or polyhedra that share points.
struct VtkGrid {
  int cell_dimension = 0;
  std::vector<double> points;                       ///< rows of 3
  std::vector<std::int64_t> connectivity, offsets;  ///< the points of each element, each once
  std::vector<std::int64_t> faces,
      face_offsets;                   ///< polyhedra: number of faces, then size and points of each
  std::vector<std::uint32_t> seed;    ///< per element
  std::vector<std::uint32_t> region;  ///< per element: of the domain; empty for whole cells
  std::vector<double> size;           ///< per element: area or volume
};

/// The convex pieces of the cells; of a solid the cells, with the faces that each has for itself. Without
/// pieces that have no extent.
VtkGrid grid_of_pieces(const DiagramOutput& output);

/// One polyhedron for each cell of a volume; walls are the same face in both cells.
/// \param path  for the message
/// \throw Error write_failed if the cells do not fit together
VtkGrid grid_of_cells(const std::string& path, const DiagramOutput& output);

}  // namespace powercell::io
