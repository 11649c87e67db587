// Cells far longer than thick: columns of a plane lattice of seeds in a large cube, tilted so that no edge is
// parallel to an axis. Their measure is known, and products of their coordinates have no correct digit of it.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/verify.hpp>
#include <vector>

#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr int kReach = 4;  // seeds on either side of the middle
constexpr std::array<double, 3> kAlong{3.0 / 7, -6.0 / 7, 2.0 / 7}, kAcross{6.0 / 7, 2.0 / 7, -3.0 / 7};

/// An oblique lattice of cells of area spacing^2 in the plane through the origin with normal (2, 3, 6) / 7.
std::vector<double> sheet(double spacing) {
  std::vector<double> x;
  for (int i = -kReach; i <= kReach; ++i)
    for (int j = -kReach; j <= kReach; ++j)
      for (std::size_t k = 0; k < 3; ++k) x.push_back(spacing * ((i + 0.3 * j) * kAlong[k] + j * kAcross[k]));
  return x;
}

bool is_inner(std::size_t seed) {
  constexpr int side = 2 * kReach + 1;
  const int i = static_cast<int>(seed) / side - kReach, j = static_cast<int>(seed) % side - kReach;
  return std::abs(i) + 1 < kReach && std::abs(j) + 1 < kReach;
}

/// Columns extend from z = -1 to z = 1, so their length is 7/3 and their middle at z = 0.
void check_columns(const Measures& measures, const std::vector<double>& seeds, double spacing, double error) {
  constexpr std::array<double, 3> up{2.0 / 6, 3.0 / 6, 1};
  for (std::size_t i = 0; i < measures.mass.size(); ++i) {
    if (!is_inner(i)) continue;
    INFO("seed " << i);
    CHECK(std::fabs(measures.mass[i] / (spacing * spacing * 7 / 3) - 1) <= error);
    const double* const seed = &seeds[3 * i];
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(std::fabs(measures.centroid[3 * i + k] - (seed[k] - seed[2] * up[k])) <= error);
  }
}

}  // namespace

TEST_CASE("cells far longer than thick have the measure and centroid of their columns") {
  const std::vector<double> low(3, -1.0), high(3, 1.0);
  const Domain domain = Domain::box(low, high);
  for (const Setup& setup : all_setups()) {
    CAPTURE(setup.name);
    for (const double spacing : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
      CAPTURE(spacing);
      const std::vector<double> x = sheet(spacing);
      const SeedsView seeds{3, x, {}};
      Diagram diagram(setup.device, domain, setup.options);
      diagram.set_seeds(seeds);
      // A wall may move by the rounding of the column's length. Results of the host have the device's
      // precision.
      const double rounding = setup.options.precision == Precision::float32 ? 1e-6 : 0;
      check_columns(diagram.measures(), x, spacing, rounding + 32 * 0x1p-53 / spacing);
      for (const LawCheck& check : verify(diagram, seeds, {200, 1})) {
        INFO(check.law << ": " << check.detail);
        CHECK(check.passed);
      }
    }
  }
}
