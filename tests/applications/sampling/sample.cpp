// Blue noise and quantisers: equal capacities, known energies and hexatic orders, reproducibility, errors.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/point_sets.hpp>
#include <powercell/sampling.hpp>

#include "lib/applications/sampling/nearest.hpp"
#include "lib/applications/sampling/state.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Checks the masses against an independent diagram of the points and weights.
void check_capacities(const Domain& domain, const Density& density, const SamplingResult& found,
                      std::size_t n) {
  CHECK(found.capacity_error < 1e-6);
  Diagram diagram(test_device(), domain);
  diagram.set_seeds({domain.dimension(), found.positions, found.weights});
  const DensityIntegrals cells = integrate(diagram, density, false);
  REQUIRE(cells.mass.size() == n);
  for (const double m : cells.mass)
    CHECK(std::abs(m * static_cast<double>(n) / cells.domain_mass - 1) < 2e-6);
}

}  // namespace

TEST_CASE("blue noise in a periodic box has the expected hexatic order, spacing and low frequencies") {
  INFO(replay_hint());
  std::vector<Spectrum> spectra;
  double mean_distance = 0;
  for (std::uint64_t run = 0; run < 3; ++run) {
    SamplingOptions options;
    options.periodic = true;
    options.random_seed = test_seed() + run;
    const SamplingResult found = sample(test_device(), unit_box(2), 400, options);
    CHECK(found.converged);
    CHECK(found.capacity_error < 1e-6);
    const Spacing even = spacing(test_device(), unit_box(2), found.positions, true);
    CHECK(even.hexatic > 0.58);
    CHECK(even.hexatic < 0.66);
    CHECK(found.steps.size() > 10);
    CHECK(found.steps.size() < 60);
    CHECK(found.relative_energy > 1.005);
    CHECK(found.relative_energy < 1.05);
    mean_distance += even.mean / 3;
    spectra.push_back(spectrum(unit_box(2), found.positions));
    for (const double x : found.positions) CHECK((x >= 0 && x <= 1));
  }
  CHECK(mean_distance == doctest::Approx(0.897).epsilon(0.02));
  CHECK(mean(spectra).low_frequency(0.5) < 4e-3);
}

TEST_CASE("capacities are equal on polygons, surfaces and volumes, and the points lie in the domain") {
  INFO(replay_hint());
  Random shape(7);
  const Domain domains[] = {unit_box(2), Domain::polygon(square_with_holes()), surface_of(torus(24, 12)),
                            unit_box(3), volume_of(cube_tetrahedra(2, 0.1, shape))};
  for (const Domain& domain : domains) {
    const Density density = Density::formula("1.5 + x");
    SamplingOptions options;
    options.density = density;
    options.iterations = 5;
    options.random_seed = test_seed();
    const SamplingResult found = sample(test_device(), domain, 80, options);
    CHECK(found.steps.back().iteration <= 5);
    check_capacities(domain, density, found, 80);
    // A point is in the domain if it is in its Voronoi cell.
    Diagram voronoi(test_device(), domain);
    voronoi.set_seeds({domain.dimension(), found.positions, {}});
    const Cells& cells = voronoi.cells();
    const auto d = static_cast<std::size_t>(domain.dimension());
    for (std::size_t i = 0; i < 80; ++i) {
      std::array<double, 3> x{};
      std::copy_n(&found.positions[i * d], d, x.begin());
      const std::array<double, 3> nearest = nearest_in_cell(cells, i, x);
      CHECK(std::hypot(nearest[0] - x[0], nearest[1] - x[1], nearest[2] - x[2]) < 1e-9);
    }
  }
}

TEST_CASE("the gradient of the energy agrees with finite differences") {
  INFO(replay_hint());
  Random random(test_seed());
  SamplingOptions options;
  options.density = Density::formula("1 + x*y");
  const std::vector<double> positions = scatter(Distribution::white, 30, 2, {}, random).positions;
  const Domain domain = unit_box(2);
  SamplingState state(test_device(), domain, options, positions);
  state.move_to(positions, 1e-11, 500);
  const std::vector<double> gradient = state.energy_gradient();
  const double step = 1e-5;
  for (const std::size_t k : {0u, 7u, 22u, 41u}) {
    std::vector<double> moved = positions;
    moved[k] += step;
    state.move_to(moved, 1e-11, 500);
    const double up = state.energy();
    moved[k] -= 2 * step;
    state.move_to(moved, 1e-11, 500);
    CHECK(std::abs((up - state.energy()) / (2 * step) - gradient[k]) < 1e-6);
  }
}

TEST_CASE("quantise decreases the energy, L-BFGS faster than Lloyd") {
  INFO(replay_hint());
  SamplingOptions options;
  options.mode = SamplingMode::quantise;
  options.periodic = true;
  options.movement = 0;
  options.iterations = 30;
  options.random_seed = test_seed();
  options.descent = SamplingDescent::lloyd;
  const SamplingResult lloyd = sample(test_device(), unit_box(2), 100, options);
  options.descent = SamplingDescent::lbfgs;
  const SamplingResult lbfgs = sample(test_device(), unit_box(2), 100, options);
  CHECK(lloyd.steps.size() == 31);
  CHECK(lloyd.converged);
  // The error of an energy is the square of the capacity error.
  double before = lloyd.steps.front().energy;
  int known = 0;
  for (const SamplingStep& step : lloyd.steps) {
    if (step.capacity_error > 1e-3) continue;
    CHECK(step.energy <= before * (1 + 1e-6));
    before = step.energy;
    ++known;
  }
  CHECK(known >= 5);
  CHECK(lbfgs.energy < lloyd.energy);
  CHECK(lbfgs.relative_energy > 0.999);
  CHECK(lbfgs.relative_energy < 1.025);
  options.movement = 1e-3;
  options.iterations = 200;
  const SamplingResult rested = sample(test_device(), unit_box(2), 20, options);
  CHECK(rested.converged);
  CHECK(rested.steps.back().gradient < 1e-3 / std::sqrt(20.0));
}

TEST_CASE(
    "quantise comes to rest with its defaults, whatever the number of points, the domain and the density") {
  INFO(replay_hint());
  struct Case {
    const char* name;
    Domain domain;
    Density density = Density::constant(1);
  };
  const Case cases[] = {{"square", unit_box(2)},
                        {"square with holes", Domain::polygon(square_with_holes())},
                        {"cube", unit_box(3)},
                        {"torus", surface_of(torus(24, 12))},
                        {"slope", unit_box(2), Density::formula("1 + 1000*x^8")},
                        {"empty half", unit_box(2), Density::image({2, 1, std::vector<double>{1, 0}})}};
  for (const Case& one : cases)
    for (const std::size_t n : {1u, 10u, 80u}) {
      CAPTURE(one.name);
      CAPTURE(n);
      SamplingOptions options;
      options.density = one.density;
      options.mode = SamplingMode::quantise;
      options.random_seed = test_seed();
      const SamplingResult found = sample(test_device(), one.domain, n, options);
      CHECK(found.converged);
      CHECK(found.capacity_error < 1e-6);
      CHECK(found.steps.back().iteration < 400);
    }
}

TEST_CASE("a drawing: dots lie on the ink, masses are equal, and a low hexatic order is no failure") {
  INFO(replay_hint());
  // A ring three pixels wide and, apart from it, a spot with 3.6 points' share of the ink.
  const std::size_t side = 120;
  std::vector<double> ink(side * side, 0.0);
  for (std::size_t r = 0; r < side; ++r)
    for (std::size_t c = 0; c < side; ++c) {
      const double from_centre = std::hypot(static_cast<double>(r) - 59.5, static_cast<double>(c) - 59.5);
      if (std::abs(from_centre - 45) < 1.5 || from_centre < 3) ink[r * side + c] = 1;
    }
  SamplingOptions options;
  options.density = Density::image({side, side, ink});
  options.random_seed = test_seed();
  const SamplingResult found = sample(test_device(), unit_box(2), 120, options);
  CHECK(found.converged);
  check_capacities(unit_box(2), options.density, found, 120);
  CHECK(found.steps.back().iteration <= 100);
  for (const SamplingStep& step : found.steps) CHECK(step.newton_steps <= 8);
  std::size_t in_spot = 0;
  for (std::size_t i = 0; i < 120; ++i) {
    const auto column = static_cast<std::size_t>(found.positions[2 * i] * side);
    const auto row = side - 1 - static_cast<std::size_t>(found.positions[2 * i + 1] * side);
    CHECK(ink[row * side + column] > 0);
    in_spot += std::hypot(found.positions[2 * i] - 0.5, found.positions[2 * i + 1] - 0.5) < 0.1 ? 1 : 0;
  }
  CHECK(in_spot >= 3);
  CHECK(in_spot <= 5);
}

TEST_CASE("Lloyd's method comes to rest too, with about the energy of L-BFGS") {
  INFO(replay_hint());
  for (const std::size_t n : {10u, 50u, 200u}) {
    CAPTURE(n);
    SamplingOptions options;
    options.mode = SamplingMode::quantise;
    options.random_seed = test_seed();
    const SamplingResult lbfgs = sample(test_device(), unit_box(2), n, options);
    options.descent = SamplingDescent::lloyd;
    const SamplingResult lloyd = sample(test_device(), unit_box(2), n, options);
    CHECK(lbfgs.converged);
    CHECK(lloyd.converged);
    CHECK(lloyd.steps.back().gradient < 1e-4 / std::sqrt(static_cast<double>(n)));
    CHECK(lbfgs.steps.size() < lloyd.steps.size());
    CHECK(lloyd.relative_energy == doctest::Approx(lbfgs.relative_energy).epsilon(0.03));
    if (n >= 50) CHECK(lbfgs.relative_energy < 1.05);
  }
}

TEST_CASE("the hexagonal lattice is a fixed point, with relative energy 1") {
  const double height = 6 * std::sqrt(0.75);
  const std::array<double, 2> low{0, 0}, high{6, height};
  std::vector<double> lattice;
  for (int r = 0; r < 6; ++r)
    for (int c = 0; c < 6; ++c) {
      lattice.push_back(c + (r % 2 ? 0.75 : 0.25));
      lattice.push_back((r + 0.5) * std::sqrt(0.75));
    }
  SamplingOptions options;
  options.mode = SamplingMode::quantise;
  options.periodic = true;
  const SamplingResult found = sample(test_device(), Domain::box(low, high), lattice, options);
  CHECK(found.converged);
  CHECK(found.relative_energy == doctest::Approx(1).epsilon(1e-9));
  for (std::size_t k = 0; k < lattice.size(); ++k) CHECK(std::abs(found.positions[k] - lattice[k]) < 1e-9);
}

TEST_CASE("the same random seed gives the same points, another one different points") {
  SamplingOptions options;
  options.iterations = 3;
  const SamplingResult a = sample(test_device(), unit_box(2), 50, options),
                       b = sample(test_device(), unit_box(2), 50, options);
  CHECK(a.positions == b.positions);
  options.random_seed = 2;
  CHECK(sample(test_device(), unit_box(2), 50, options).positions != a.positions);
}

TEST_CASE("points in a row, on islands and few points move, whatever the initial hexatic order") {
  const std::array<double, 2> low{0, 0}, high{1000, 1};
  const Domain strip = Domain::box(low, high);
  const SamplingResult row = sample(test_device(), strip, 100);
  CHECK(row.converged);
  CHECK(row.steps.back().iteration == 20);
  CHECK(row.relative_energy < 10);  // above 500 for random points; 5.2 for cells of 10 x 1
  for (const std::size_t n : {1u, 2u, 3u, 4u, 6u, 10u}) {
    INFO(n << " points");
    for (const bool periodic : {false, true}) {
      SamplingOptions options;
      options.periodic = periodic;
      const SamplingResult found = sample(test_device(), unit_box(2), n, options);
      CHECK(found.converged);
      CHECK(found.steps.back().iteration > 0);
      CHECK(found.relative_energy < 1.4);
    }
    CHECK(sample(test_device(), Domain::polygon(islands()), n).converged);
  }
}

TEST_CASE("given points outside move into the domain, and duplicates are refused") {
  for (const SamplingDescent descent : {SamplingDescent::lloyd, SamplingDescent::lbfgs})
    for (const double movement : {1e-4, 1e9}) {
      SamplingOptions options;
      options.mode = movement > 1 ? SamplingMode::quantise : SamplingMode::blue;
      options.descent = descent;
      options.movement = movement;
      const std::vector<double> outside{5, 5, 6, 6, 7, 5.5, 0.5, 0.5};
      for (const double x : sample(test_device(), unit_box(2), outside, options).positions)
        CHECK(x == std::clamp(x, 0.0, 1.0));
    }
  const std::vector<double> twice{0.2, 0.2, 0.5, 0.5, 0.2, 0.2};
  CHECK_THROWS_AS(sample(test_device(), unit_box(2), twice), Error);
}

TEST_CASE("invalid options and domains are refused, and progress may interrupt") {
  const auto code = [](std::size_t n, const SamplingOptions& options, const Domain& domain = unit_box(2)) {
    try {
      sample(test_device(), domain, n, options);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::internal;
  };
  SamplingOptions options;
  CHECK(code(0, options) == ErrorCode::invalid_argument);
  options.iterations = -1;
  CHECK(code(5, options) == ErrorCode::invalid_argument);
  options = {};
  options.capacity_tolerance = 0;
  CHECK(code(5, options) == ErrorCode::invalid_argument);
  options = {};
  options.periodic = true;
  const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::vector<std::uint32_t> tetrahedron{0, 1, 2, 3};
  CHECK(code(5, options, Domain::volume(corners, tetrahedron)) == ErrorCode::unsupported);
  options.density = Density::formula("1+x");
  CHECK(code(5, options) == ErrorCode::unsupported);
  options = {};
  options.density = Density::formula("x - 0.5");
  CHECK(code(5, options) == ErrorCode::invalid_argument);
  options = {};
  options.progress = [](const SamplingStep& step) { return step.iteration < 2; };
  CHECK(code(20, options) == ErrorCode::interrupted);
  const std::vector<double> odd{0.1, 0.2, 0.3};
  CHECK_THROWS_AS(sample(test_device(), unit_box(2), odd, {}), Error);
}
