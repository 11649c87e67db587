/// \file
/// Domains with seeds for the tests of densities, and a check of walls against derivatives of the masses.
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

/// Boxes, a polygon with holes and a mesh of tetrahedra, with n weighted seeds each.
std::vector<DensityCase> flat_cases(std::size_t n);

/// Compares integrals over the walls with finite differences of the masses with respect to some weights,
/// (15).
/// \param density_scale  a typical value of the density, for the tolerance
void check_walls_are_derivatives(const DensityCase& one, const Density& density, double density_scale);

/// A diagram of these seeds, on the first device in its best precision.
Diagram diagram_of(const DensityCase& one);

}  // namespace powercell::test
