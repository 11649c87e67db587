// mpirun -n 4 transport_ranks --n 1000000: equal masses for random seeds in the unit square or cube, in parts
// along a Hilbert curve, on ranks of MPI with PETSc; with --one-process the same by one process without them.
// The first rank prints a line for each step and one for all. Exits 1 if the solve does not converge.
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <powercell/distributed_transport.hpp>
#include <powercell/mpi.hpp>
#include <powercell/petsc.hpp>

#include "bench/clocks.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/shares.hpp"

using namespace powercell;
using namespace powercell::bench;
using namespace powercell::test;

namespace {

struct Work {
  std::size_t n = 100000;
  int dimension = 3;
  Distribution distribution = Distribution::white;
  bool one_process = false;
  double linear_residual = 1e-4;
};

double megabytes() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_maxrss) / 1024;
}

void print_step(const TransportStep& step) {
  std::printf(
      "  step %d %s: error %.2e, empty %zu, length %.3g, diagrams %d (%.2f s), linear %d iterations (%.2f "
      "s), residual %.1e\n",
      step.step, name(step.phase), step.error, step.empty, step.length, step.diagrams, step.diagram_seconds,
      step.linear_iterations, step.linear_seconds, step.linear_residual);
  std::fflush(stdout);
}

/// \return whether it converged
bool run(const Work& work) {
  MpiCommunicator communicator;
  PetscSolver solver;
  const auto ranks = static_cast<std::size_t>(communicator.size()),
             rank = static_cast<std::size_t>(communicator.rank());
  Random random(1);
  const SeedArray seeds = random_seeds(work.distribution, WeightRange::W0, work.n, work.dimension, random);
  const Device device = Device::choose();
  const Domain domain = unit_box(work.dimension);
  DistributedTransportOptions options;
  options.transport.linear_residual = work.linear_residual;
  if (rank == 0)
    options.transport.progress = [](const TransportStep& step) {
      print_step(step);
      return true;
    };
  const Shares shares = along_curve(seeds, ranks);
  const double start = wall_seconds(), used = processor_seconds();
  const TransportResult found =
      work.one_process ? transport(device, domain, seeds.view(), {}, options.transport)
                       : transport_distributed(communicator, solver, device, domain,
                                               {work.dimension, shares.positions[rank], shares.weights[rank]},
                                               {}, options);
  double sums[2] = {processor_seconds() - used, megabytes()};
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  if (rank == 0)
    std::printf(
        "%zu seeds in %dD on %zu ranks: %s, error %.2e, %zu Newton steps, %zu diagrams, %.1f s, %.1f "
        "processor s, %.0f MB in all\n",
        work.n, work.dimension, ranks, found.converged ? "converged" : "NOT CONVERGED", found.error,
        found.newton_steps(), found.diagrams, wall_seconds() - start, sums[0], sums[1]);
  return found.converged;
}

}  // namespace

int main(int argc, char** argv) {
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  CLI::App app("Transport on ranks; other options are PETSc's");
  app.allow_extras();
  Work work;
  std::string kind = "white";
  app.add_option("--n", work.n, "number of seeds");
  app.add_option("--dimension", work.dimension, "2 or 3");
  app.add_option("--seeds", kind, "white or cluster")->check(CLI::IsMember({"white", "cluster"}));
  app.add_option("--linear-residual", work.linear_residual, "of each system");
  app.add_flag("--one-process", work.one_process, "without PETSc, on one rank");
  CLI11_PARSE(app, argc, argv);
  if (kind == "cluster") work.distribution = Distribution::cluster;
  PetscInitialize(&argc, &argv, nullptr, nullptr);
  const bool converged = run(work);
  PetscFinalize();
  MPI_Finalize();
  return converged ? 0 : 1;
}
