/// \file
/// Diagrams that densities are tested on, and the check that walls are the derivatives of the masses.
#pragma once

#include <powercell/density.hpp>
#include <string>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

struct DensityCase {
  std::string name;
  Domain domain;
  SeedArray seeds;
};

/// A box, a polygon with holes and a mesh of tetrahedra, with n seeds of different weights.
std::vector<DensityCase> flat_cases(std::size_t n);

/// (15): changes some weights and compares the change of the masses with the walls.
/// \param density_scale  a typical value of the density
void check_walls_are_derivatives(const DensityCase& one, const Density& density, double density_scale);

/// \return a diagram with these seeds, on the first device in its best precision
Diagram diagram_of(const DensityCase& one);

}  // namespace powercell::test
