// Measures of a few cells that are known.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/solid/both_ways.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The unit cube without the cube of edge 1/2 in its middle.
Domain hollow_cube() {
  Random random(1);
  return volume_of(part_of(cube_tetrahedra(4, 0, random), [](const std::array<double, 3>& x) {
    return std::max({std::abs(x[0] - .5), std::abs(x[1] - .5), std::abs(x[2] - .5)}) > .25;
  }));
}

}  // namespace

TEST_CASE("solid: a hollow cube in one cell, wherever its seed lies") {
  if (!has_double()) return;
  for (const double x : {0.5, 0.05, -3.0}) {
    SeedArray seeds;
    seeds.push({x, 0.5, 0.5}, 0);
    const BothWays both = compute_both_ways(hollow_cube(), seeds);
    CHECK(both.by_boundary.mass[0] == doctest::Approx(7.0 / 8).epsilon(1e-14));
    CHECK(both.by_boundary.centroid[0] == doctest::Approx(0.5).epsilon(1e-14));
    // About the middle, 1/4 for the cube of edge 1; the smaller one has 2^-5 of that.
    const double about_middle = 0.25 * (1 - 1.0 / 32), shift = x - 0.5;
    CHECK(both.by_boundary.second_moment[0] ==
          doctest::Approx(about_middle + 7.0 / 8 * shift * shift).epsilon(1e-14));
  }
}

TEST_CASE("solid: two cells of a hollow cube") {
  if (!has_double()) return;
  // The wall at x = 0.4 is a square with a square hole.
  SeedArray seeds;
  seeds.push({0.1, 0.4, 0.6}, 0);
  seeds.push({0.7, 0.4, 0.6}, 0);
  const BothWays both = compute_both_ways(hollow_cube(), seeds);
  CHECK(both.by_boundary.mass[0] == doctest::Approx(0.4 - 0.15 / 4).epsilon(1e-14));
  CHECK(both.by_boundary.mass[1] == doctest::Approx(0.6 - 0.35 / 4).epsilon(1e-14));
  REQUIRE(both.walls_by_boundary.wall.size() == 2);
  CHECK(both.walls_by_boundary.wall[0] == doctest::Approx(0.75).epsilon(1e-14));
}

TEST_CASE("solid: a cell in the cavity is hidden, and the others have no wall with it") {
  if (!has_double()) return;
  SeedArray seeds;
  seeds.push({0.5, 0.5, 0.5}, 0);
  for (const double x : {-0.05, 1.05}) seeds.push({x, 0.5, 0.5}, 0);
  for (const double y : {-0.05, 1.05}) seeds.push({0.5, y, 0.5}, 0);
  for (const double z : {-0.05, 1.05}) seeds.push({0.5, 0.5, z}, 0);
  for (double& w : seeds.weights) w = 0;
  seeds.weights[0] = -0.2;  // its cell is the cube |x - 1/2| < 0.0932 about the middle
  const BothWays both = compute_both_ways(hollow_cube(), seeds);
  CHECK(both.by_boundary.status[0] == SeedStatus::hidden);
  CHECK(both.by_boundary.mass[0] == 0);
  for (std::size_t i = 1; i < 7; ++i)
    CHECK(both.by_boundary.mass[i] == doctest::Approx(7.0 / 48).epsilon(1e-13));
  CHECK(both.walls_by_boundary.offset[1] == 0);
}
