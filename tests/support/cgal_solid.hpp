/// \file
/// Cells in a solid by CGAL: exact Boolean operations on triangle meshes.
#pragma once

#include <cstddef>
#include <powercell/seeds.hpp>

#include "tests/support/meshes.hpp"

namespace powercell::test {

struct CutSolid {
  double volume = 0, area = 0;  ///< of the part and of its whole surface
  bool known = true;            ///< whether CGAL could compute it: its surface is a manifold
};

/// The part of the cell of seed i in a solid.
/// \param surface  closed and manifold, without crossings, outward, in [-2, 2]^3
CutSolid cut_solid(const Mesh& surface, const SeedsView& seeds, std::size_t i);

}  // namespace powercell::test
