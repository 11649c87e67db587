// Hard cases: empty initial cells, seeds outside the domain, extreme masses, duplicates, failure to converge,
// interruption, invalid input.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/applications/transport/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

SeedArray white(std::size_t n, int d = 2) {
  Random random(test_seed());
  return random_seeds(Distribution::white, WeightRange::W0, n, d, random);
}

TransportResult solve(const Domain& domain, const SeedsView& seeds, std::span<const double> masses = {},
                      const TransportOptions& options = transport_options()) {
  return transport(transport_device(), domain, seeds, masses, options);
}

bool has_phase(const TransportResult& result, TransportPhase phase) {
  for (const TransportStep& step : result.steps)
    if (step.phase == phase) return true;
  return false;
}

/// Checks that no step of damped Newton has an empty cell.
void check_no_empty_newton_step(const TransportResult& result) {
  for (const TransportStep& step : result.steps)
    if (step.phase == TransportPhase::newton || step.phase == TransportPhase::ramp) CHECK(step.empty == 0);
}

}  // namespace

TEST_CASE("initial weights with empty cells are scaled down") {
  INFO(replay_hint());
  SeedArray seeds = white(200);
  const TransportResult cold = solve(unit_box(2), seeds.view());
  REQUIRE(cold.converged);
  seeds.weights = cold.weights;
  seeds.weights[17] -= 0.02;  // hidden by its neighbours
  Diagram diagram(transport_device(), unit_box(2), transport_options().diagram);
  diagram.set_seeds(seeds.view());
  REQUIRE(diagram.measures().count(SeedStatus::hidden) > 0);
  const TransportResult found = solve(unit_box(2), seeds.view());
  CHECK(found.converged);
  CHECK(found.steps.front().diagrams > 1);
  CHECK(found.steps.front().empty == 0);
  CHECK(distance(found.weights, cold.weights) < 1e-6);
  check_no_empty_newton_step(found);
}

TEST_CASE("seeds outside the domain, beyond one side and in a notch") {
  INFO(replay_hint());
  const Domain letter = Domain::polygon(letter_u());
  SeedArray seeds = white(60);
  for (double& x : seeds.positions) x = 5 + 0.1 * x;
  for (const Domain& domain : {unit_box(2), letter}) {
    const TransportResult found = solve(domain, seeds.view());
    CHECK(found.converged);
    CHECK((found.steps.front().empty > 0 || !has_phase(found, TransportPhase::ascent)));
    check_no_empty_newton_step(found);
  }
}

TEST_CASE("disconnected polygons, whose cells share no wall") {
  INFO(replay_hint());
  Random random(test_seed());
  const Domain domain = Domain::polygon(islands());
  const SeedArray seeds = seeds_for(domain, Distribution::white, WeightRange::W0, 50, random);
  const TransportResult found = solve(domain, seeds.view(), random_masses(50, 5, domain.measure(), random));
  CHECK(found.converged);
  CHECK(found.diagrams <= 60);
}

TEST_CASE("masses over six orders of magnitude") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3}) {
    const SeedArray seeds = white(300, d);
    const TransportResult found = solve(unit_box(d), seeds.view(), random_masses(300, 1e6, 1, random));
    INFO(d << "D, " << found.steps.size() << " steps, " << found.diagrams << " diagrams");
    CHECK(found.converged);
    check_no_empty_newton_step(found);
  }
}

TEST_CASE("seeds at one position are merged, with the sum of their masses") {
  const std::vector<double> positions{0.2, 0.2, 0.7, 0.7, 0.2, 0.2, 0.7, 0.2};
  const std::vector<double> masses{0.1, 0.3, 0.2, 0.4};
  TransportSolver solver(transport_device(), unit_box(2), transport_options());
  solver.set_seeds({2, positions, {}});
  solver.set_masses(masses);
  const TransportResult found = solver.solve();
  REQUIRE(found.converged);
  CHECK(found.merged == 1);
  CHECK(found.merged_with == std::vector<std::uint32_t>{0, 1, 0, 3});
  CHECK(std::abs(found.mass[0] - 0.3) < 1e-6);
  CHECK(found.mass[2] == 0);
  CHECK(std::isnan(found.centroid[4]));
  CHECK(found.weights[2] == found.weights[0]);
  // The diagram has all seeds, in their order.
  const Measures& cells = solver.diagram().measures();
  REQUIRE(cells.mass.size() == 4);
  CHECK(cells.status[2] == SeedStatus::duplicate);
  CHECK(std::abs(cells.mass[3] - 0.4) < 1e-6);
}

TEST_CASE("failure to converge is reported, and the best weights are returned") {
  INFO(replay_hint());
  const SeedArray seeds = white(300);
  TransportOptions options = transport_options();
  options.max_steps = 2;
  const TransportResult found = solve(unit_box(2), seeds.view(), {}, options);
  CHECK(!found.converged);
  CHECK(found.newton_steps() == 2);
  double least = std::numeric_limits<double>::infinity();
  for (const TransportStep& step : found.steps) least = std::min(least, step.error);
  CHECK(found.error == least);
  CHECK(found.error >= found.tolerance);
  Diagram diagram(transport_device(), unit_box(2), transport_options().diagram);
  diagram.set_seeds({2, seeds.positions, found.weights});
  CHECK(distance(diagram.measures().mass, found.mass) < 1e-14);

  options = transport_options();
  options.tolerance = 1e-17;  // below rounding errors: the solver must stop by itself
  CHECK(!solve(unit_box(2), seeds.view(), {}, options).converged);
}

TEST_CASE("a density with a jump: the reported errors cover the true error of the masses") {
  // 1 to the left of x = 0.37 and 5 to the right: as a function, and as an image, whose integrals are exact.
  const auto value = [](const std::array<double, 3>& x) { return x[0] < 0.37 ? 1.0 : 5.0; };
  std::vector<double> pixels(100, 5.0);
  std::fill_n(pixels.begin(), 37, 1.0);
  const Density exact = Density::image({100, 1, pixels});
  TransportOptions options = transport_options();
  options.max_steps = 20;
  int converged = 0, refused = 0;
  for (const std::uint64_t which : {1u, 3u})
    for (const auto& bounds : {std::pair{1e-9, 1e-5}, {1e-2, 1e-5}, {1e-2, 1e-1}}) {
      const double integrals = bounds.first, tolerance = bounds.second;
      INFO("seeds " << which << ", integrals to " << integrals << ", tolerance " << tolerance);
      options.density = Density::function(value, integrals);
      Random random(which);
      const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 24, 2, random);
      options.tolerance = tolerance;
      TransportSolver solver(transport_device(), unit_box(2), options);
      solver.set_seeds(seeds.view());
      const TransportResult& found = solver.solve();
      const std::vector<double> mass = integrate(solver.diagram(), exact, false).mass;
      double off = 0;
      for (std::size_t i = 0; i < mass.size(); ++i)
        off = std::max(off, std::abs(mass[i] / found.target[i] - 1));
      INFO("masses are off by " << off << ", reported are " << found.error << " and "
                                << found.quadrature_error);
      CHECK(off < found.error + found.quadrature_error);
      CHECK(found.converged == (found.error < tolerance && found.quadrature_error < tolerance));
      (found.converged ? converged : refused) += 1;
      if (integrals < tolerance) CHECK(found.converged);
    }
  CHECK(converged > 0);
  CHECK(refused > 0);
  options.density = exact;
  options.tolerance = 0;
  const TransportResult found = solve(unit_box(2), white(24).view(), {}, options);
  CHECK(found.converged);
  CHECK(found.quadrature_error == 0);
}

TEST_CASE("the diagram is that of the result, whatever was tried last") {
  INFO(replay_hint());
  Random random(test_seed());
  const Domain domain = Domain::polygon(islands());
  const SeedArray seeds = seeds_for(domain, Distribution::white, WeightRange::W0, 40, random);
  const std::vector<double> masses = random_masses(40, 1e4, domain.measure(), random);
  for (int most = 1; most < 60; most += 3) {
    TransportOptions options = transport_options();
    options.max_steps = most;
    TransportSolver solver(transport_device(), domain, options);
    solver.set_seeds(seeds.view());
    solver.set_masses(masses);
    const TransportResult& found = solver.solve();
    CHECK(distance(solver.diagram().measures().mass, found.mass) < 1e-12);
  }
}

TEST_CASE("an interrupted solve leaves the last diagram; changed seeds have none") {
  const SeedArray seeds = white(200);
  TransportOptions options = transport_options();
  bool stop = false;
  options.progress = [&stop](const TransportStep& step) { return !stop || step.step < 2; };
  TransportSolver solver(transport_device(), unit_box(2), options);
  solver.set_seeds(seeds.view());
  const std::vector<double> found = solver.solve().mass;
  Random random(test_seed());
  solver.set_masses(random_masses(200, 10, 1, random));
  stop = true;
  CHECK_THROWS_AS(solver.solve(), Error);
  CHECK(distance(solver.diagram().measures().mass, found) < 1e-12);
  solver.move_seeds(seeds.positions);
  CHECK_THROWS_AS(solver.diagram(), Error);
  solver.set_seeds(SeedArray{2, {0.5, 0.5}, {0}}.view());
  CHECK_THROWS_AS(solver.diagram(), Error);
}

TEST_CASE("seeds a million domains away") {
  SeedArray seeds = white(100);
  translate(seeds, {1e6, -1e6, 0});
  CHECK(solve(unit_box(2), seeds.view()).converged);
}

TEST_CASE("masses and densities at the limits of doubles are met or refused") {
  const SeedArray seeds = white(4);
  TransportOptions options = transport_options();
  options.rescale = true;
  for (const double mass : {1e308, 1e-320}) {
    const TransportResult found = solve(unit_box(2), seeds.view(), std::vector<double>(4, mass), options);
    CHECK(found.converged);
    CHECK(std::abs(found.target[0] - 0.25) < 1e-15);
  }
  CHECK_THROWS_AS(solve(unit_box(2), seeds.view(), std::vector<double>{1e-300, 1e300, 1e300, 1e300}, options),
                  Error);
  const std::array<double, 2> low{0, 0}, high{10, 10}, tiny{1e-9, 1e-9};
  CHECK_THROWS_AS(Density::constant(1e308), Error);
  options.density = Density::constant(1e100);
  CHECK(solve(Domain::box(low, high), seeds.view(), {}, options).converged);
  options.density = Density::constant(1e-310);
  CHECK_THROWS_AS(solve(Domain::box(low, tiny), seeds.view(), {}, options), Error);
}

TEST_CASE("after a move to the centroids a solve takes about two steps") {
  INFO(replay_hint());
  const SeedArray seeds = white(1000);
  TransportOptions options = transport_options();
  options.tolerance = 1e-2;
  TransportSolver solver(transport_device(), unit_box(2), options);
  solver.set_seeds(seeds.view());
  std::size_t steps = 0;
  for (int round = 0; round < 10; ++round) {
    const TransportResult& found = solver.solve();
    REQUIRE(found.converged);
    if (round >= 3) steps += found.newton_steps();
    const std::vector<double> centroids = found.centroid;
    solver.move_seeds(centroids);
  }
  CHECK(steps <= 7 * 2);
}

TEST_CASE("progress may interrupt a solve, and the solver can be used again") {
  TransportOptions options = transport_options();
  bool stop = true;
  options.progress = [&stop](const TransportStep& step) { return !stop || step.step < 2; };
  TransportSolver solver(transport_device(), unit_box(2), options);
  const SeedArray seeds = white(200);
  solver.set_seeds(seeds.view());
  try {
    solver.solve();
    FAIL("was not interrupted");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::interrupted);
  }
  stop = false;
  CHECK(solver.solve().converged);
}

TEST_CASE("invalid input is refused with a message that names it") {
  const std::vector<double> positions{0.2, 0.2, 0.7, 0.7};
  TransportSolver solver(transport_device(), unit_box(2), transport_options());
  const auto refused = [](const auto& call, const char* says) {
    try {
      call();
      FAIL("accepted");
    } catch (const Error& error) {
      INFO(error.what());
      CHECK(std::string(error.what()).find(says) != std::string::npos);
    }
  };
  refused([&] { solver.solve(); }, "there are no seeds");
  refused([&] { solver.set_seeds({2, {}, {}}); }, "no seeds");
  refused([&] { solver.diagram(); }, "before solve");
  solver.set_seeds({2, positions, {}});
  for (const double bad : {-1.0, 0.0, std::nan(""), std::numeric_limits<double>::infinity()})
    refused([&] { solver.set_masses(std::vector<double>{1, bad}); }, "seed 1: the mass is");
  refused([&] { solver.set_masses(std::vector<double>{1}); }, "1 masses for 2 seeds");
  refused([&] { solver.move_seeds(std::vector<double>{1}); }, "1 coordinates for 2 seeds");
  refused([&] { solver.set_weights(std::vector<double>{1, std::nan("")}); }, "seed 1");
  refused([&] { solver.set_tolerance(-1); }, "tolerance");
  solver.set_masses(std::vector<double>{2, 3});
  refused([&] { solver.solve(); }, "sum to 5, the domain's mass is 1");
  solver.set_masses(std::vector<double>{0.4, 0.6});
  CHECK(solver.solve().converged);

  TransportOptions options = transport_options();
  options.rescale = true;
  const TransportResult found = solve(unit_box(2), {2, positions, {}}, std::vector<double>{2, 3}, options);
  CHECK(found.converged);
  CHECK(std::abs(found.mass[0] - 0.4) < 1e-6);
}
