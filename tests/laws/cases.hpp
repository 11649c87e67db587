/// \file
/// A domain of each kind that can be moved and scaled with its seeds.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

/// x -> scale * rotation x + shift; in the plane a turn about the origin, in space two turns.
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

/// Polygon with holes, torus, tetrahedra: each moved, with n seeds moved alike (weights scaled by
/// scale^2). The same for the same test seed but for the motion.
std::vector<Case> cases(std::size_t n, WeightRange range, const Motion& motion = {});

/// Allowed relative error of a sum over the domain.
double partition_tolerance(Precision precision);

}  // namespace powercell::test
