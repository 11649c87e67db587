/// \file
/// Triangle and tetrahedral meshes of named shapes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "tests/support/generators.hpp"

namespace powercell::test {

/// nv x 3 coordinates, and 3 or 4 vertex indices per element.
struct Mesh {
  std::vector<double> vertices;
  std::vector<std::uint32_t> elements;
  std::size_t vertex_count() const { return vertices.size() / 3; }
};

Mesh icosphere(int subdivisions);    ///< radius 1 about 0, closed
Mesh torus(int around, int across);  ///< radii 1 and 0.4 about the z axis, closed
Mesh wavy_patch(int per_axis);       ///< open: a height field over the unit square
Mesh book(int pages);                ///< non-manifold: rectangles that share one edge
/// The unit cube as 6 tetrahedra per grid cell. Inner vertices are moved by up to `jitter` cells, and every
/// other tetrahedron is inverted, as may occur in files.
Mesh cube_tetrahedra(int per_axis, double jitter, Random& random);
/// The tetrahedra of a mesh for whose centroids `keep` is true.
Mesh part_of(Mesh mesh, const std::function<bool(const std::array<double, 3>&)>& keep);
Mesh ball_tetrahedra(int subdivisions);  ///< an icosphere's triangles joined to its centre

}  // namespace powercell::test
