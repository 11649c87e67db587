// Transport problems with known weights and cost: moved grids, one and two seeds.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/applications/transport/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

void check_moved_grid(const MovedGrid& moved, int dimension, TransportOptions options, double accuracy,
                      double cost_accuracy) {
  const TransportResult found =
      transport(transport_device(), moved.domain, {dimension, moved.positions, {}}, {}, options);
  REQUIRE(found.converged);
  CHECK(found.error < found.tolerance);
  CHECK(distance(found.weights, moved.weights) <= accuracy);
  CHECK(std::abs(found.primal - moved.cost) <= cost_accuracy);
  CHECK(std::abs(found.dual - moved.cost) <= cost_accuracy);
}

}  // namespace

TEST_CASE("the weights of a grid moved and scaled within the domain, 1,000 to 2,500 seeds") {
  TransportOptions options = transport_options();
  options.tolerance = 1e-9;
  for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::multilevel}) {
    INFO(name(solver));
    options.linear = solver;
    check_moved_grid(MovedGrid(32, 2, 0.7, 0.03), 2, options, 1e-10, 1e-10);
    check_moved_grid(MovedGrid(10, 3, 0.7, 0.03), 3, options, 1e-10, 1e-10);
  }
  options.linear = LinearSolver::automatic;
  check_moved_grid(MovedGrid(50, 2, 0.7, 0.03), 2, options, 1e-10, 1e-10);
  check_moved_grid(MovedGrid(13, 3, 0.8, 0.02), 3, options, 1e-10, 1e-10);
}

TEST_CASE("the weights of a grid moved out of the domain") {
  TransportOptions options = transport_options();
  options.tolerance = 1e-9;
  check_moved_grid(MovedGrid(20, 2, 3, 0), 2, options, 1e-9, 1e-9);  // larger costs, larger rounding
  check_moved_grid(MovedGrid(20, 2, 0.5, 4), 2, options, 1e-9, 1e-9);
  check_moved_grid(MovedGrid(8, 3, 0.3, -2), 3, options, 1e-9, 1e-9);
}

TEST_CASE("single precision: masses to 1e-3, weights to a hundredth of the cell area") {
  const TransportOptions options = transport_options(Precision::float32);
  check_moved_grid(MovedGrid(32, 2, 0.7, 0.03), 2, options, 1e-2 / 1024, 1e-6);
  check_moved_grid(MovedGrid(60, 2, 0.7, 0.03), 2, options, 1e-2 / 3600, 1e-6);
  check_moved_grid(MovedGrid(10, 3, 0.7, 0.03), 3, options, 1e-2 / 100, 1e-6);
}

TEST_CASE("one seed, and two seeds with a known wall") {
  const Domain square = unit_box(2);
  const std::vector<double> one{0.3, 0.4};
  const TransportResult alone = transport(transport_device(), square, {2, one, {}}, {}, transport_options());
  CHECK(alone.converged);
  CHECK(alone.weights[0] == 0);
  CHECK(std::abs(alone.mass[0] - 1) < 1e-14);

  const std::vector<double> two{0.25, 0.5, 0.75, 0.5}, masses{0.9, 0.1};
  TransportOptions options = transport_options();
  options.tolerance = 1e-12;
  const TransportResult found = transport(transport_device(), square, {2, two, {}}, masses, options);
  REQUIRE(found.converged);
  // The wall x = 0.9 is 0.65 from one seed and 0.15 from the other: w_0 - w_1 = 0.65² - 0.15².
  CHECK(std::abs(found.weights[0] - found.weights[1] - 0.4) < 1e-12);
  CHECK(std::abs(found.weights[0] + found.weights[1]) < 1e-14);
  CHECK(std::abs(found.centroid[0] - 0.45) < 1e-12);
  CHECK(std::abs(found.centroid[2] - 0.95) < 1e-12);
}
