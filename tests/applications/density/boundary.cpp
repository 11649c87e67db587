// Formulas that are defined in the domain only, such as sqrt(1 - x - y). Rounding puts vertices of cells
// beyond the boundary, where the formula is negative or NaN.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/applications/density/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Checks that `formula` has the integrals of `beyond`, which agrees with it in the domain and is a density
/// everywhere.
void check_same(const DensityCase& one, const std::string& formula, const std::string& beyond) {
  INFO(one.name, ", ", formula);
  constexpr double tolerance = 1e-6;
  Diagram diagram = diagram_of(one);
  const Density density = Density::formula(formula, tolerance);
  const DensityIntegrals found = integrate(diagram, density, true);
  const DensityIntegrals expected = integrate(diagram, Density::formula(beyond, tolerance), true);
  CHECK(found.domain_mass == doctest::Approx(expected.domain_mass).epsilon(10 * tolerance));
  for (std::size_t i = 0; i < found.mass.size(); ++i)
    CHECK(std::abs(found.mass[i] - expected.mass[i]) <=
          10 * tolerance * expected.mass[i] + found.mass_error[i] + expected.mass_error[i]);
}

DensityCase seeds_in(const char* name, const Domain& domain, Random& random) {
  return {name, domain, seeds_for(domain, Distribution::white, WeightRange::W1, 200, random)};
}

/// Scales the positions of a Voronoi diagram by `far`, with weights that give the same cells: |x - far a|² -
/// w is far (|x - a|² + c(x)) for w = far² |a|² - far |a|².
SeedArray seen_from_afar(SeedArray seeds, double far) {
  seeds.weights.clear();
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    double square = 0;
    for (int k = 0; k < seeds.dimension; ++k) square += seeds.coordinate(i, k) * seeds.coordinate(i, k);
    seeds.weights.push_back((far - 1) * far * square);
  }
  for (double& x : seeds.positions) x *= far;
  return seeds;
}

}  // namespace

TEST_CASE("a formula may be undefined beyond the boundary of the domain") {
  INFO(replay_hint());
  Random random(test_seed());
  const Parts triangle{{{{0, 0}, {1, 0}, {0, 1}}, {}}};
  const DensityCase in_triangle = seeds_in("triangle", Domain::polygon(triangle), random);
  check_same(in_triangle, "1-x-y", "max(0, 1-x-y)");
  check_same(in_triangle, "sqrt(1-x-y)", "sqrt(max(0, 1-x-y))");
  CHECK(Density::formula("sqrt(1-x-y)").total(in_triangle.domain) == doctest::Approx(4.0 / 15).epsilon(1e-9));

  Parts circle{{}};
  for (int k = 0; k < 90; ++k)
    circle[0].outer.push_back({std::cos(k * std::acos(-1.0) / 45), std::sin(k * std::acos(-1.0) / 45)});
  check_same(seeds_in("circle", Domain::polygon(circle), random), "sqrt(1-x^2-y^2)",
             "sqrt(max(0, 1-x^2-y^2))");
  check_same(seeds_in("sphere", surface_of(icosphere(2)), random), "sqrt(1-x^2-y^2)",
             "sqrt(max(0, 1-x^2-y^2))");
  check_same(seeds_in("ball", volume_of(ball_tetrahedra(1)), random), "1-x^2-y^2-z^2",
             "max(0, 1-x^2-y^2-z^2)");
}

TEST_CASE("a formula may be undefined beyond the boundary when seeds are far away") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3})
    for (const double far : {10.0, 1e3, 1e6, 1e9}) {
      const double low[] = {0, 0, 0}, high[] = {0.7, 0.7, 0.7};
      const auto n = static_cast<std::size_t>(d);
      DensityCase one{"box", Domain::box(std::span(low).first(n), std::span(high).first(n)), {}};
      one.seeds = seen_from_afar(scatter(Distribution::white, 30, d, {}, random), far);
      INFO(far);
      check_same(one, "0.7-x", "max(0, 0.7-x)");
    }
}

TEST_CASE("a formula that is invalid inside the domain or infinite at its boundary is refused") {
  const Domain square = unit_box(2);
  for (const char* formula : {"x-0.001", "sqrt(x-0.001)", "1/x", "1/sqrt(y)"}) {
    INFO(formula);
    CHECK_THROWS_AS(Density::formula(formula).total(square), Error);
  }
}
