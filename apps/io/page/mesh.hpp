/// \file
/// The cells of a diagram as faces with shared points, for pages that draw them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/io/write/output.hpp"

namespace powercell::io {

/// Polygons and surfaces: the convex pieces of the cells. Volumes: the faces of the joined cells, a wall
/// between two cells once, as seen from outside the cell `inner`. In a periodic domain, where cells are
/// whole, a wall with an image of a cell is of one cell alone.
struct ViewMesh {
  int dimension = 0;
  /// A point x is at offset + scale * x. The scale is a power of two, and the points lie about the origin, so
  /// that their rounding is 2^-24 of the domain wherever it lies.
  std::array<double, 3> offset{};
  double scale = 1;
  std::vector<float> points;          ///< np x dimension
  std::vector<std::int8_t> normals;   ///< surfaces: np x 3, times 127
  std::vector<std::int32_t> corners;  ///< points of the faces, one face after the other
  std::vector<std::int32_t> sizes;    ///< corners of each face, at least 3
  std::vector<std::int32_t> inner;    ///< cell of each face, ascending
  std::vector<std::int32_t> outer;    ///< volumes: the cell behind the face, -1 if none

  std::size_t triangles() const { return corners.size() - 2 * sizes.size(); }
};

ViewMesh view_mesh(const DiagramOutput& output);

}  // namespace powercell::io
