// Laplacians: the assembled matrix, every solver against known solutions, breakdown, and the iteration counts
// and symmetry of the multilevel preconditioner.
#include <doctest/doctest.h>

#include <cmath>

#include "lib/applications/linear/laplacian.hpp"
#include "lib/applications/linear/multilevel.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Graph {
  std::vector<std::uint64_t> offset{0};
  std::vector<std::uint32_t> neighbor;
  std::vector<double> conductance;
  std::size_t size() const { return offset.size() - 1; }
};

/// A grid of k^d unknowns. The conductances between neighbours are spread over a factor `range`,
/// symmetrically.
Graph grid_graph(std::uint32_t k, int d, double range) {
  Graph graph;
  const auto n = static_cast<std::uint32_t>(std::lround(std::pow(k, d)));
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto add = [&](std::uint32_t j) {
      graph.neighbor.push_back(j);
      Random random(std::uint64_t{std::min(i, j)} * n + std::max(i, j));
      graph.conductance.push_back(std::pow(range, random.uniform()));
    };
    const std::uint32_t x = i % k, y = i / k % k, z = i / k / k;
    if (d == 3 && z > 0) add(i - k * k);
    if (y > 0) add(i - k);
    if (x > 0) add(i - 1);
    if (x + 1 < k) add(i + 1);
    if (y + 1 < k) add(i + k);
    if (d == 3 && z + 1 < k) add(i + k * k);
    graph.offset.push_back(graph.neighbor.size());
  }
  return graph;
}

Laplacian system_of(const Graph& graph, std::span<const double> shift = {}) {
  return make_laplacian(graph.offset, graph.neighbor, graph.conductance, shift);
}

Vector random_vector(std::size_t n, Random& random) {
  Vector v(static_cast<Eigen::Index>(n));
  for (double& x : v) x = random.normal();
  return v;
}

/// Iterations of the multilevel solver to a residual of 1e-4.
int iterations(std::uint32_t k, int d, double range) {
  Random random(test_seed());
  const Graph graph = grid_graph(k, d, range);
  const LinearResult found = solve_laplacian(system_of(graph), random_vector(graph.size(), random),
                                             LinearSolver::multilevel, 1e-4, d);
  CHECK(found.residual <= 1.01e-4);
  return found.iterations;
}

}  // namespace

TEST_CASE("the rows of a Laplacian are sorted and sum to the shift") {
  const Graph graph = grid_graph(4, 3, 10);
  std::vector<double> shift(graph.size());
  for (std::size_t i = 0; i < shift.size(); ++i) shift[i] = static_cast<double>(i % 3);
  const Laplacian shifted = system_of(graph, shift);
  CHECK(!shifted.singular);
  CHECK(shifted.matrix.isCompressed());
  CHECK(static_cast<std::size_t>(shifted.matrix.nonZeros()) == graph.neighbor.size() + graph.size());
  for (Eigen::Index i = 0; i < shifted.matrix.rows(); ++i) {
    double sum = 0;
    Eigen::Index last = -1;
    for (SparseRows::InnerIterator entry(shifted.matrix, i); entry; ++entry) {
      CHECK(entry.col() > last);
      last = entry.col();
      sum += entry.value();
      if (entry.col() != i) CHECK(entry.value() < 0);
    }
    CHECK(std::abs(sum - shift[static_cast<std::size_t>(i)]) < 1e-12);
  }
}

TEST_CASE("every solver finds a known solution, with mean 0 if the system is singular") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const auto& [k, d] : {std::pair<std::uint32_t, int>{1, 2}, {2, 2}, {7, 2}, {40, 2}, {6, 3}, {13, 3}})
    for (const bool shifted : {false, true}) {
      const Graph graph = grid_graph(k, d, 1000);
      const std::string points = std::to_string(k) + '^' + std::to_string(d);
      const std::vector<double> shift(graph.size(), 0.01);
      const Laplacian system = shifted ? system_of(graph, shift) : system_of(graph);
      Vector expected = random_vector(graph.size(), random);
      if (!shifted) expected.array() -= expected.mean();
      Vector right = system.matrix * expected;
      if (!shifted) right.array() += 0.5;  // the solver subtracts the mean
      for (const LinearSolver solver :
           {LinearSolver::dense, LinearSolver::direct, LinearSolver::multilevel}) {
        INFO(points << ", " << name(solver) << (shifted ? " shifted" : ""));
        const LinearResult found = solve_laplacian(system, right, solver, 1e-12, d);
        CHECK(found.solver == solver);
        CHECK((found.solution - expected).norm() <= 1e-8 * (1 + expected.norm()));
        CHECK(found.residual <= 1e-11);
        if (!shifted) CHECK(std::abs(found.solution.mean()) < 1e-12);
      }
    }
}

TEST_CASE("a null space and infinite entries are reported as breakdown") {
  Graph graph = grid_graph(3, 2, 1);
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (std::uint64_t k = graph.offset[i]; k < graph.offset[i + 1]; ++k)
      if (i == 4 || graph.neighbor[k] == 4) graph.conductance[k] = 0;
  std::vector<double> shift(graph.size(), 1);
  for (const LinearSolver solver : {LinearSolver::direct, LinearSolver::multilevel}) {
    shift[4] = 1;
    const Vector right = Vector::Ones(9);
    CHECK(!solve_laplacian(system_of(graph, shift), right, solver, 1e-12, 2).broke_down);
    shift[4] = 0;
    CHECK(solve_laplacian(system_of(graph, shift), right, solver, 1e-12, 2).broke_down);
  }
  shift[0] = INFINITY;
  CHECK(solve_laplacian(system_of(graph, shift), Vector::Ones(9), LinearSolver::dense, 1e-12, 2).broke_down);
}

TEST_CASE("connected components are those of the nonzero entries") {
  Graph graph = grid_graph(5, 2, 1);
  CHECK(connected_components(system_of(graph).matrix) == 1);
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (std::uint64_t k = graph.offset[i]; k < graph.offset[i + 1]; ++k)
      if (i / 5 != graph.neighbor[k] / 5) graph.conductance[k] = 0;
  CHECK(connected_components(system_of(graph).matrix) == 5);
}

TEST_CASE("the iterations of the multilevel solver grow slowly from 1,000 to 100,000 unknowns") {
  INFO(replay_hint());
  for (const double range : {1.0, 1000.0}) {
    const int plane[] = {iterations(32, 2, range), iterations(100, 2, range), iterations(316, 2, range)};
    MESSAGE("plane, conductances over " << range << ": " << plane[0] << ", " << plane[1] << ", " << plane[2]);
    CHECK(plane[2] <= plane[0] + 10);
    CHECK(plane[2] <= 30);
    const int space[] = {iterations(10, 3, range), iterations(22, 3, range), iterations(46, 3, range)};
    MESSAGE("space, conductances over " << range << ": " << space[0] << ", " << space[1] << ", " << space[2]);
    CHECK(space[2] <= space[0] + 10);
    CHECK(space[2] <= 30);
  }
}

TEST_CASE("the preconditioner is symmetric and positive definite, and its operator complexity is below 2") {
  INFO(replay_hint());
  Random random(test_seed());
  const Graph graph = grid_graph(60, 2, 100);
  const Laplacian system = system_of(graph);
  Multilevel multilevel(system);
  CHECK(multilevel.levels() >= 2);
  CHECK(multilevel.complexity() < 2);
  Vector a = random_vector(graph.size(), random), b = random_vector(graph.size(), random), ma, mb;
  a.array() -= a.mean();
  b.array() -= b.mean();
  multilevel.apply(a, ma);
  multilevel.apply(b, mb);
  CHECK(std::abs(a.dot(mb) - b.dot(ma)) <= 1e-10 * std::abs(a.dot(ma)));
  CHECK(a.dot(ma) > 0);
}
