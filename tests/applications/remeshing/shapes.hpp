/// \file
/// Meshes for the tests of remeshing.
#pragma once

#include <cstdint>
#include <powercell/shapes.hpp>
#include <string>
#include <vector>

namespace powercell::test {

TriangleMesh cube_of_12();                              ///< the unit cube, two triangles a side
TriangleMesh plate(double thickness);                   ///< the unit square with a thickness, 12 triangles
TriangleMesh cone(std::uint32_t sides, double radius);  ///< height 1, closed by its base
TriangleMesh bumpy_ball();                              ///< closed, with varying radius
TriangleMesh wavy_sheet();                              ///< open, one boundary loop with four corners
TriangleMesh tube();                                    ///< open at both ends, two boundary loops
TriangleMesh small_torus();

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
  int euler, loops;
};
std::vector<NamedMesh> smooth_meshes();

}  // namespace powercell::test
