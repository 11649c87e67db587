/// \file
/// The surface that remeshing makes of an input mesh, with edges above 45 degrees kept.
#pragma once

#include "lib/applications/remeshing/surface.hpp"
#include "tests/applications/remeshing/shapes.hpp"

namespace powercell::test {

inline remeshing::Surface surface_from(const TriangleMesh& mesh) {
  return remeshing::make_surface(mesh.vertices, mesh.triangles, 45);
}

}  // namespace powercell::test
