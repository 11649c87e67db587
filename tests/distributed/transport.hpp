/// \file
/// Transport on ranks beside that of all seeds in one process.
#pragma once

#include <powercell/distributed_transport.hpp>

#include "tests/exchange/compare.hpp"

namespace powercell::test {

/// A problem whose seeds are in one array.
struct TransportProblem {
  Domain domain;
  SeedArray seeds;
  std::vector<double> masses;  ///< of the seeds; empty for equal ones
};

/// Masses over a factor `range`, with the sum of the domain's measure.
inline std::vector<double> masses_for(const Domain& domain, std::size_t n, double range, Random& random) {
  std::vector<double> masses(n);
  for (double& mass : masses) mass = std::pow(range, random.uniform());
  const double sum = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (double& mass : masses) mass *= domain.measure() / sum;
  return masses;
}

/// The masses of the seeds with these numbers.
inline std::vector<double> masses_of(const TransportProblem& problem, const std::vector<std::uint64_t>& ids) {
  std::vector<double> masses;
  for (const std::uint64_t id : ids)
    if (!problem.masses.empty()) masses.push_back(problem.masses[id]);
  return masses;
}

/// The solution of one rank.
inline TransportResult solve_rank(Communicator& communicator, DistributedLinearSolver& solver,
                                  const TransportProblem& problem, const Shares& shares,
                                  const DistributedTransportOptions& options = {}) {
  const auto rank = static_cast<std::size_t>(communicator.rank());
  const std::vector<double> masses = masses_of(problem, shares.ids[rank]);
  return transport_distributed(communicator, solver, test_device(), problem.domain,
                               {shares.dimension, shares.positions[rank], shares.weights[rank]}, masses,
                               options);
}

/// One process may take fewer steps from clusters of seeds and from seeds outside, which it spreads over the
/// domain first: so many.
inline constexpr int from_afar = 12;

/// Compares the solution of a rank with that of one process, with its number of steps but for `more`.
inline void check_rank_solution(const TransportProblem& problem, const std::vector<std::uint64_t>& ids,
                                const TransportResult& found, const TransportResult& expected, int more = 1) {
  const auto d = static_cast<std::size_t>(problem.seeds.dimension);
  const double spacing = std::pow(problem.domain.measure() / static_cast<double>(problem.seeds.size()),
                                  1.0 / static_cast<double>(d));
  REQUIRE(found.mass.size() == ids.size());
  REQUIRE(found.centroid.size() == d * ids.size());
  CHECK(found.converged);
  REQUIRE(expected.converged);
  CHECK(std::abs(static_cast<int>(found.newton_steps()) - static_cast<int>(expected.newton_steps())) <= more);
  CHECK(found.merged == expected.merged);
  CHECK(found.total_mass == expected.total_mass);
  CHECK(std::abs(found.dual - expected.dual) <= 1e-8 * std::abs(expected.dual));
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const std::size_t i = ids[k];
    CAPTURE(i);
    CHECK(std::abs(found.target[k] - expected.target[i]) <= 1e-14 * expected.target[i]);
    CHECK(std::abs(found.weights[k] - expected.weights[i]) <= 1e-4 * spacing * spacing);
    CHECK((found.mass[k] > 0) == (expected.mass[i] > 0));
    CHECK(std::abs(found.mass[k] - expected.mass[i]) <= 2e-6 * expected.mass[i]);
    if (expected.mass[i] > 0)
      for (std::size_t c = 0; c < d; ++c)
        CHECK(std::abs(found.centroid[k * d + c] - expected.centroid[i * d + c]) <= 1e-4 * spacing);
  }
}

inline TransportResult in_one_process(const TransportProblem& problem) {
  return transport(test_device(), problem.domain, problem.seeds.view(), problem.masses);
}

}  // namespace powercell::test
