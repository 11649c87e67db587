/// \file
/// The faces of one joined cell, made from its welded pieces.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/collect/join_weld.hpp"

namespace powercell {

/// Loops over the vertices of a CellWeld, as CellWeld::same() numbers them.
struct JoinedFaces {
  std::vector<std::uint32_t> loop;
  std::vector<std::size_t> end;     ///< per face: end of its loop
  std::vector<Border> face_border;  ///< per face (volumes)
  std::vector<Border> edge_border;  ///< per loop entry (polygons and surfaces)

  void clear();
};

/// Polygon: chains the remaining edges into rings with the cell on the left. No ring passes a vertex twice.
/// Edges that the cutting of the domain split are rejoined.
void join_rings(const CellWeld& weld, JoinedFaces& faces);

/// Surface: each piece stays a face, without edges whose ends are welded.
void join_triangles(const CellWeld& weld, JoinedFaces& faces);

/// Volume: takes the remaining faces. Joins the faces of one wall if they form a polygon without holes, and
/// removes vertices that only split an edge between two walls.
void join_polyhedron(const CellWeld& weld, JoinedFaces& faces);

/// The pieces of each cell, joined: join() of a domain that is not periodic.
JoinedCells join_pieces(const Domain& domain, const Cells& cells);

}  // namespace powercell
