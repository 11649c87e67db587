/// \file
/// Simple domains made on the spot, as plain arrays: for demonstrations, tests and first steps.
#pragma once

#include <cstdint>
#include <powercell/domain.hpp>
#include <vector>

namespace powercell {

/// What Domain::surface takes.
struct TriangleMesh {
  std::vector<double> vertices;          ///< nv x 3, row-major
  std::vector<std::uint32_t> triangles;  ///< nt x 3, indices from 0, counter-clockwise seen from outside
};

/// What Domain::volume takes.
struct TetrahedralMesh {
  std::vector<double> vertices;           ///< nv x 3, row-major
  std::vector<std::uint32_t> tetrahedra;  ///< nt x 4, indices from 0, positively oriented
};

/// A regular polygon with its corners on the unit circle about 0, counter-clockwise from (1, 0).
/// \param segments at least 3   \throw Error invalid_argument
POWERCELL_API Ring disk(int segments);

/// The unit sphere about 0: an icosahedron with each edge cut in `resolution`, spread evenly. It has
/// 10 resolution^2 + 2 vertices and 20 resolution^2 triangles.
/// \param resolution 1 to 4096   \throw Error invalid_argument
POWERCELL_API TriangleMesh sphere(int resolution);

/// The torus about the z axis, radius 1 to the middle of the tube, radius 0.4 of the tube, with
/// `resolution` segments around the tube and n = ceil(2.5 resolution) around the axis. It has
/// n resolution vertices and twice as many triangles.
/// \param resolution 3 to 16384   \throw Error invalid_argument
POWERCELL_API TriangleMesh torus(int resolution);

/// The unit ball about 0: an octahedron with each edge cut in `resolution`, rounded. It has
/// 8 resolution^3 tetrahedra.
/// \param resolution 1 to 256   \throw Error invalid_argument
POWERCELL_API TetrahedralMesh ball(int resolution);

}  // namespace powercell
