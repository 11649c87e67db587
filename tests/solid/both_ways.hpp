/// \file
/// Measures and walls of a volume by its boundary and by its tetrahedra.
#pragma once

#include <powercell/diagram.hpp>
#include <string>
#include <vector>

#include "tests/support/meshes.hpp"

namespace powercell::test {

struct NamedMesh {
  std::string name;
  Mesh mesh;
};

/// Tetrahedra of six shapes: convex and not, in one part and in two, with a cavity, and full of holes.
std::vector<NamedMesh> solid_meshes(Random& random);
/// Seeds a quarter apart over these shapes, moved by `shift` along each axis: walls lie in faces of the
/// shapes, or seeds in their vertices.
SeedArray quarters(double shift);

struct BothWays {
  Measures by_boundary, by_tetrahedra;
  Adjacency walls_by_boundary, walls_by_tetrahedra;
  std::size_t unclear = 0;  ///< cells of the first that were left to the tetrahedra
};

/// On a device with double precision. \pre the domain has several tetrahedra
BothWays compute_both_ways(const Domain& domain, const SeedArray& seeds);

/// The same with the first from a solid that has the boundary of the second domain as its surface.
BothWays compute_without_tetrahedra(const Domain& solid, const Domain& domain, const SeedArray& seeds);

/// The boundary of a volume as a mesh of triangles.
Mesh boundary_mesh(const Domain& domain);

/// What differs by more than rounding: 10^-12 of the mean measure or of the mean wall. Empty if nothing does.
std::string differences(const BothWays& both, const SeedArray& seeds);

/// Whether some device has double precision.
bool has_double();
/// \pre has_double()
Device double_device_of_tests();

}  // namespace powercell::test
