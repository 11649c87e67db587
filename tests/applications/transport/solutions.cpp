// Properties of every solution, on every kind of domain: derivatives, masses, duality, agreement of linear
// solvers.
#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "lib/applications/transport/diagram_evaluator.hpp"
#include "tests/applications/transport/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::vector<double> masses_at(Diagram& diagram, const std::vector<double>& weights) {
  diagram.set_weights(weights);
  return diagram.measures().mass;
}

/// Compares central differences of masses and dual, with respect to the weight of every fifth seed, with (15)
/// and v - m.
void check_derivatives(const TransportCase& one) {
  const std::size_t n = one.seeds.size();
  Diagram diagram(transport_device(), one.domain, transport_options().diagram);
  diagram.set_seeds(one.seeds.view());
  const Vector target = Eigen::Map<const Vector>(one.masses.data(), static_cast<Eigen::Index>(n));
  const TransportOptions options;
  DiagramEvaluator evaluator(diagram, one.seeds.positions, {target, 1e-6}, options);
  const Vector at = Vector::Zero(static_cast<Eigen::Index>(n));
  const Iterate here = evaluator.evaluate(at);
  const Vector gradient = here.gradient(target);
  const double h = spacing(one.domain.measure(), n, one.domain.cell_dimension()), step = 1e-5 * h * h;
  const double unit = std::pow(h, one.domain.cell_dimension() - 2);
  for (std::size_t j = 0; j < n; j += 5) {
    Vector weights = at;
    weights[static_cast<Eigen::Index>(j)] += step;
    const Iterate up = evaluator.evaluate(weights);
    weights[static_cast<Eigen::Index>(j)] -= 2 * step;
    const Iterate down = evaluator.evaluate(weights);
    const double slope = (up.dual(target) - down.dual(target)) / (2 * step);
    CHECK(std::abs(slope - gradient[static_cast<Eigen::Index>(j)]) <= 1e-4 * unit * h * h);
    const Adjacency& walls = here.cells.walls;
    std::vector<double> expected(n);
    for (std::uint64_t k = walls.offset[j]; k < walls.offset[j + 1]; ++k) {
      expected[walls.neighbor[k]] = -here.conductance[k];
      expected[j] += here.conductance[k];
    }
    for (std::size_t i = 0; i < n; ++i) {
      INFO("d m_" << i << " / d w_" << j);
      const double found = (up.cells.mass[i] - down.cells.mass[i]) / (2 * step);
      CHECK(std::abs(found - expected[i]) <= 1e-3 * (unit + std::abs(expected[i])));
    }
  }
}

}  // namespace

TEST_CASE("gradient and Hessian agree with finite differences") {
  INFO(replay_hint());
  for (const TransportCase& one : transport_cases(60, 3)) {
    INFO(one.name);
    check_derivatives(one);
  }
}

TEST_CASE("masses are met, and the primal and dual values agree") {
  INFO(replay_hint());
  TransportOptions options = transport_options();
  options.tolerance = 1e-8;
  for (const TransportCase& one : transport_cases(200, 10)) {
    INFO(one.name);
    const TransportResult found =
        transport(transport_device(), one.domain, one.seeds.view(), one.masses, options);
    REQUIRE(found.converged);
    // Measured again by an independent diagram.
    Diagram diagram(transport_device(), one.domain);
    diagram.set_seeds({one.seeds.dimension, one.seeds.positions, found.weights});
    const std::vector<double> mass = masses_at(diagram, found.weights);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      CHECK(std::abs(mass[i] / one.masses[i] - 1) < 2e-8);
      CHECK(found.mass[i] == doctest::Approx(mass[i]).epsilon(1e-12));
    }
    CHECK(std::abs(found.primal - found.dual) <= 1e-8 * found.primal);
    CHECK(std::abs(std::accumulate(found.weights.begin(), found.weights.end(), 0.0)) < 1e-10);
    // The dual is a lower bound at any weights, hence at those of the first step.
    CHECK(found.steps.front().dual <= found.dual);
    CHECK(found.newton_steps() <= 120);  // 80 for the letter U: a fifth of the seeds lies in its notch
  }
}

TEST_CASE("dense, direct and multilevel solvers give the same weights") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 400, 2, random);
  const std::vector<double> masses = random_masses(400, 10, 1, random);
  TransportOptions options = transport_options();
  options.tolerance = 1e-10;
  std::vector<std::vector<double>> weights;
  for (const LinearSolver solver : {LinearSolver::dense, LinearSolver::direct, LinearSolver::multilevel}) {
    options.linear = solver;
    const TransportResult found = transport(transport_device(), unit_box(2), seeds.view(), masses, options);
    REQUIRE(found.converged);
    CHECK(found.steps.back().linear == solver);
    weights.push_back(found.weights);
  }
  CHECK(distance(weights[0], weights[1]) < 1e-12);
  CHECK(distance(weights[0], weights[2]) < 1e-12);
}
