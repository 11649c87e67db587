// Densities that are nearly 0 in most of the domain, so that damped Newton has no useful derivatives at
// first.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/applications/transport/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Place = std::array<double, 3>;

/// A normal distribution about `middle`, with mass 1 in the plane.
double bell(const Place& x, const Place& middle, double width) {
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k) square += (x[k] - middle[k]) * (x[k] - middle[k]);
  return std::exp(-square / (2 * width * width)) / (2 * std::numbers::pi * width * width);
}

TransportResult solve(std::size_t n, const Density& density, double tolerance = 0) {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, n, 2, random);
  TransportOptions options = transport_options();
  options.density = density;
  options.tolerance = tolerance;
  TransportSolver solver(transport_device(), unit_box(2), options);
  solver.set_seeds(seeds.view());
  const TransportResult& found = solver.solve();
  CHECK(found.converged);
  CHECK(found.primal == doctest::Approx(found.dual).epsilon(1e-5));
  REQUIRE(!found.steps.empty());
  CHECK(found.steps.back().spread == 0);
  // The masses are those of the density itself, not of a blend.
  const std::vector<double> mass = integrate(solver.diagram(), density, false).mass;
  for (std::size_t i = 0; i < n; ++i)
    CHECK(mass[i] == doctest::Approx(found.target[i]).epsilon(1e-5 + 2 * tolerance));
  return found;
}

bool blended(const TransportResult& result) {
  return std::any_of(result.steps.begin(), result.steps.end(),
                     [](const TransportStep& step) { return step.spread > 0; });
}

}  // namespace

TEST_CASE("a normal distribution: the start moves the seeds onto it") {
  INFO(replay_hint());
  for (const double width : {0.1, 0.03, 0.01})
    for (const std::size_t n : {30u, 400u}) {
      INFO("width " << width << ", " << n << " seeds");
      const TransportResult found = solve(n, Density::function([width](const Place& x) {
                                            return bell(x, {0.41, 0.63, 0}, width);
                                          }));
      CHECK(found.diagrams <= 60);  // from weights 0 it takes hundreds or does not converge
    }
}

TEST_CASE("a density with bounded support: the start moves the seeds inside") {
  INFO(replay_hint());
  const auto cone = [](const Place& x) {
    return std::max(0.0, 0.01 - (x[0] - 0.5) * (x[0] - 0.5) - (x[1] - 0.5) * (x[1] - 0.5));
  };
  const auto pyramid = [](const Place& x) {
    return std::max(0.0, 0.1 - std::abs(x[0] - 0.3) - std::abs(x[1] - 0.4));
  };
  for (const std::size_t n : {30u, 200u})
    for (const Density& density : {Density::function(cone), Density::function(pyramid)}) {
      if (n > 30 && !all_inputs()) continue;
      INFO(n << " seeds");
      const TransportResult found = solve(n, density, 1e-4);
      CHECK(!blended(found));
      CHECK(found.diagrams <= 60);
    }
}

TEST_CASE("a density with a jump at its edge: converges if the integrals are accurate enough, else stops") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 100, 2, random);
  for (const double integrals : {1e-9, 1e-3}) {
    CAPTURE(integrals);
    TransportOptions options = transport_options();
    options.density = Density::function(
        [](const Place& x) { return std::abs(x[0] - 0.3) + std::abs(x[1] - 0.4) < 0.1 ? 1.0 : 0.0; },
        integrals);
    TransportSolver solver(transport_device(), unit_box(2), options);
    solver.set_seeds(seeds.view());
    const TransportResult& found = solver.solve();
    CHECK(found.converged == (integrals < found.tolerance));
    CHECK(found.converged == (found.quadrature_error < found.tolerance));
    CHECK((found.converged || found.error < found.quadrature_error));
    CHECK(found.diagrams <= 60);
  }
}

TEST_CASE("two peaks: the density is blended with a uniform one of decreasing share") {
  INFO(replay_hint());
  const TransportResult found = solve(60, Density::function([](const Place& x) {
                                        return bell(x, {0.2, 0.2, 0}, 0.04) + bell(x, {0.8, 0.7, 0}, 0.04);
                                      }));
  CHECK(blended(found));
  // The smallest share must be well below the first.
  double least = 1;
  for (const TransportStep& step : found.steps) {
    CHECK(step.spread >= 0);
    CHECK(step.spread <= 1);
    least = std::min(least, step.spread > 0 ? step.spread : 1);
  }
  CHECK(least < 0.1);
}

TEST_CASE("a density of moderate variation is not blended") {
  INFO(replay_hint());
  const TransportResult found =
      solve(200, Density::function([](const Place& x) { return 1 + x[0] + 3 * x[1] * x[1]; }));
  CHECK(!blended(found));
  CHECK(found.diagrams <= 30);
}
