// Constant densities: measures and walls times the value.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/applications/density/cases.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("a constant density multiplies masses, second moments and walls") {
  INFO(replay_hint());
  for (const DensityCase& one : flat_cases(60)) {
    INFO(one.name);
    Diagram diagram = diagram_of(one);
    const DensityIntegrals found = integrate(diagram, Density::constant(2.5), true);
    const Measures& plain = diagram.measures();
    const Adjacency& walls = diagram.adjacency();
    REQUIRE(found.mass.size() == one.seeds.size());
    for (std::size_t i = 0; i < found.mass.size(); ++i) {
      CHECK(found.mass[i] == 2.5 * plain.mass[i]);
      CHECK(found.second_moment[i] == 2.5 * plain.second_moment[i]);
      CHECK(found.status[i] == plain.status[i]);
    }
    REQUIRE(found.walls.neighbor == walls.neighbor);
    for (std::size_t k = 0; k < walls.wall.size(); ++k) CHECK(found.walls.wall[k] == 2.5 * walls.wall[k]);
    CHECK(found.domain_mass == 2.5 * one.domain.measure());
    CHECK(found.relative_error() < 1e-12);
    CHECK(integrate(diagram, Density::constant(1), false).walls.offset.empty());
    check_walls_are_derivatives(one, Density::constant(2.5), 2.5);
  }
}

TEST_CASE("a constant density must be positive and at most the largest value") {
  for (const double bad : {0.0, -1.0, 1.01e100, std::numeric_limits<double>::infinity(), std::nan("")})
    CHECK_THROWS_AS(Density::constant(bad), Error);
}
