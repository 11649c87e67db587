/// \file
/// The surface of the part of a cell in a solid, as polygons.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "lib/solid/cell_in_solid.hpp"

namespace powercell::solid {

/// Closed: each edge of a face is that of another one in the opposite direction. Faces are convex and
/// counter-clockwise seen from outside. Where seeds tie, they may have no extent.
struct CellFaces {
  std::vector<double> vertices;      ///< 3 each, in coordinates relative to the seed
  std::vector<std::uint32_t> loop;   ///< vertices of the faces
  std::vector<std::size_t> end;      ///< per face: the end of its loop
  std::vector<std::int32_t> border;  ///< per face: a rank, or ~t for triangle t of the boundary
  /// The ranks behind the three walls at each vertex of the cell that lies in the solid.
  std::vector<std::array<std::uint32_t, 3>> corners;
};

struct CellFacesInput {
  const CellInSolid& cell;
  std::span<const BoundaryPiece> pieces;  ///< that were added to `cell`, in this order
  double rounding;                        ///< edges that are not longer are points
};

/// \pre label(), and set_sides() for a uniform cell
CellFaces make_cell_faces(const CellFacesInput& input);

}  // namespace powercell::solid
