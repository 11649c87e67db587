/// \file
/// The faces of one joined cell, made from its welded pieces. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/collect/join_weld.hpp"

namespace powercell {

/// Loops over the vertices of a CellWeld, each vertex by the one that stands for it.
struct JoinedFaces {
  std::vector<std::uint32_t> loop;
  std::vector<std::size_t> end;     ///< per face: where its loop ends
  std::vector<Border> face_border;  ///< per face (volumes)
  std::vector<Border> edge_border;  ///< per loop entry (polygons and surfaces)

  void clear();
};

/// Polygon: chains the edges that are left into rings. A ring meets no vertex twice; where two meet in a
/// vertex, each keeps the cell on its left. An edge that the cutting of the domain has split is one again.
void join_rings(const CellWeld& weld, JoinedFaces& faces);

/// Surface: each piece stays a face; edges between welded vertices are gone.
void join_triangles(const CellWeld& weld, JoinedFaces& faces);

/// Volume: the faces that are left, those of one wall made one polygon where they form one without holes,
/// and without the vertices that only split an edge between two walls.
void join_polyhedron(const CellWeld& weld, JoinedFaces& faces);

}  // namespace powercell
