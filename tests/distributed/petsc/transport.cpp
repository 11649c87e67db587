// Transport on ranks of MPI with PETSc, with the transport of all seeds in one process as the oracle.
#include "tests/distributed/transport.hpp"

#include <powercell/mpi.hpp>
#include <powercell/petsc.hpp>

using namespace powercell;
using namespace powercell::test;

TEST_CASE("PETSc: the steps and weights of one process, in the plane and in space") {
  MpiCommunicator communicator;
  PetscSolver solver;
  const auto ranks = static_cast<std::size_t>(communicator.size()),
             rank = static_cast<std::size_t>(communicator.rank());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
      INFO(dimension << "D " << name(distribution));
      const Domain domain = unit_box(dimension);
      TransportProblem problem{
          domain, random_seeds(distribution, WeightRange::W0, 250, dimension, random), {}};
      if (distribution == Distribution::white) problem.masses = masses_for(domain, 250, 5, random);
      const TransportResult expected = in_one_process(problem);
      const Shares shares = along_curve(problem.seeds, ranks);
      const TransportResult found = solve_rank(communicator, solver, problem, shares);
      check_rank_solution(problem, shares.ids[rank], found, expected,
                          distribution == Distribution::cluster ? from_afar : 1);
      for (const TransportStep& step : found.steps) {
        CHECK((step.linear_iterations > 0) == (step.phase != TransportPhase::start));
        CHECK(step.linear_residual <= 1.01e-4);
      }
    }
}

TEST_CASE("PETSc: ranks without seeds, one seed, and steps past empty cells") {
  MpiCommunicator communicator;
  PetscSolver solver;
  const auto ranks = static_cast<std::size_t>(communicator.size()),
             rank = static_cast<std::size_t>(communicator.rank());
  Random random(test_seed());
  for (const std::size_t n : {1U, 2U, 30U}) {
    CAPTURE(n);
    const TransportProblem problem{
        unit_box(3), random_seeds(Distribution::white, WeightRange::W0, n, 3, random), {}};
    const Shares shares(problem.seeds, std::vector<std::size_t>(n, ranks - 1), ranks);
    check_rank_solution(problem, shares.ids[rank], solve_rank(communicator, solver, problem, shares),
                        in_one_process(problem));
  }
  // Outside a notch: the ascent adds to the diagonal, so that its systems are not singular.
  TransportProblem outside{
      Domain::polygon(letter_u()), random_seeds(Distribution::white, WeightRange::W0, 60, 2, random), {}};
  for (double& x : outside.seeds.positions) x = 5 + 0.1 * x;
  const Shares shares = at_random(outside.seeds, ranks, random);
  check_rank_solution(outside, shares.ids[rank], solve_rank(communicator, solver, outside, shares),
                      in_one_process(outside), from_afar);
}

TEST_CASE("PETSc: an error on one rank is thrown on all, who then solve") {
  MpiCommunicator communicator;
  PetscSolver solver;
  const auto ranks = static_cast<std::size_t>(communicator.size());
  Random random(test_seed());
  const TransportProblem problem{
      unit_box(2), random_seeds(Distribution::white, WeightRange::W0, 100, 2, random), {}};
  const Shares shares = along_curve(problem.seeds, ranks);
  DistributedTransportOptions options;
  if (communicator.rank() + 1 == communicator.size())
    options.transport.progress = [](const TransportStep& step) { return step.step < 2; };
  CHECK_THROWS_AS(solve_rank(communicator, solver, problem, shares, options), Error);
  CHECK(solve_rank(communicator, solver, problem, shares).converged);
}
