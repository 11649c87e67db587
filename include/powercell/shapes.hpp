/// \file
/// Simple shapes as plain arrays, for examples and tests.
#pragma once

#include <cstdint>
#include <powercell/domain.hpp>
#include <vector>

namespace powercell {

/// A triangle mesh, as Domain::surface takes it. Owns its arrays.
struct TriangleMesh {
  std::vector<double> vertices;          ///< nv x 3, row-major
  std::vector<std::uint32_t> triangles;  ///< nt x 3, indices from 0, counter-clockwise seen from outside
};

/// A tetrahedral mesh, as Domain::volume takes it. Owns its arrays.
struct TetrahedralMesh {
  std::vector<double> vertices;           ///< nv x 3, row-major
  std::vector<std::uint32_t> tetrahedra;  ///< nt x 4, indices from 0, positively oriented
};

/// A regular polygon inscribed in the unit circle about the origin, counter-clockwise from (1, 0).
/// \param segments  number of corners, at least 3
/// \throw Error invalid_argument
POWERCELL_API Ring disk(int segments);

/// The unit sphere about the origin: an icosahedron with each edge divided into `resolution` parts, projected
/// to the sphere with nearly even spacing. It has 10 resolution^2 + 2 vertices and 20 resolution^2 triangles.
/// \param resolution  1 to 4096
/// \throw Error invalid_argument
POWERCELL_API TriangleMesh sphere(int resolution);

/// The torus about the z axis with major radius 1 and minor radius 0.4. It has `resolution` segments around
/// the tube and n = ceil(2.5 resolution) around the axis: n resolution vertices and twice as many triangles.
/// \param resolution  3 to 16384
/// \throw Error invalid_argument
POWERCELL_API TriangleMesh torus(int resolution);

/// The unit ball about the origin: an octahedron with each edge divided into `resolution` parts, mapped to
/// the ball. It has 8 resolution^3 tetrahedra.
/// \param resolution  1 to 256
/// \throw Error invalid_argument
POWERCELL_API TetrahedralMesh ball(int resolution);

}  // namespace powercell
