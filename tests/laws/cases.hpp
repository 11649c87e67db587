/// \file
/// Domains that can be moved and scaled with their seeds.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

/// x -> scale * rotation x + shift; see rotate() in generators.hpp.
struct Motion {
  double scale = 1;
  double angle = 0;
  std::array<double, 3> shift{0, 0, 0};
};

struct Case {
  std::string name;
  Domain domain;
  SeedArray seeds;
};

/// Polygon with holes, torus, tetrahedra, moved with n seeds each (weights times scale^2). The seeds before
/// the motion depend on the test seed only.
std::vector<Case> cases(std::size_t n, WeightRange range, const Motion& motion = {});

/// The allowed relative error of a sum over the domain.
double partition_tolerance(Precision precision);

}  // namespace powercell::test
