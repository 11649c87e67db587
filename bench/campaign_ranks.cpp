// mpirun -n 7 campaign_ranks --n 1000000: diagrams of seeds on ranks of MPI against CGAL's regular
// triangulation of all of them. Neighbours and hidden seeds must be the same, without a tolerance. The first
// rank prints a line for each combination; the program exits 1 on any difference.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstring>
#include <powercell/distributed.hpp>
#include <powercell/mpi.hpp>

#include "bench/against_cgal.hpp"
#include "bench/clocks.hpp"
#include "bench/mpi_program.hpp"
#include "tests/support/shares.hpp"

using namespace powercell;
using namespace powercell::bench;
using namespace powercell::test;

namespace {

struct Work {
  Distribution distribution;
  WeightRange weights;
  std::size_t n;
  int dimension;
  bool redistribute;
};

template <class T>
Communicator::Message message_of(const std::vector<T>& values) {
  Communicator::Message message(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(message.data(), values.data(), message.size());
  return message;
}

/// The values of all ranks by rank, on the first one alone.
template <class T>
std::vector<std::vector<T>> on_first_rank(Communicator& communicator, const std::vector<T>& own) {
  std::vector<Communicator::Message> messages(static_cast<std::size_t>(communicator.size()));
  messages[0] = message_of(own);
  std::vector<std::vector<T>> all;
  for (const Communicator::Message& message : communicator.exchange(std::move(messages))) {
    std::vector<T>& values = all.emplace_back(message.size() / sizeof(T));
    if (!message.empty()) std::memcpy(values.data(), message.data(), message.size());
  }
  return all;
}

/// \return whether all is as in CGAL; on the first rank
bool run(Communicator& communicator, const Device& device, const Work& work) {
  Random random(1);
  const SeedArray seeds = random_seeds(work.distribution, work.weights, work.n, work.dimension, random);
  const auto ranks = static_cast<std::size_t>(communicator.size()),
             rank = static_cast<std::size_t>(communicator.rank());
  std::vector<std::size_t> shuffled(seeds.size());
  for (std::size_t& r : shuffled) r = random.index(ranks);
  const Shares shares = work.redistribute ? Shares(seeds, shuffled, ranks) : along_curve(seeds, ranks);
  const exchange::ShardSeeds own = shares.view()[rank];
  const std::vector<double> low(static_cast<std::size_t>(work.dimension), low_side),
      high(static_cast<std::size_t>(work.dimension), high_side);
  const double start = wall_seconds();
  const DistributedCells cells = compute_distributed(communicator, device, Domain::box(low, high), own.ids,
                                                     own.seeds, {{}, work.redistribute});
  const double spent = wall_seconds() - start;
  const auto status = on_first_rank(communicator, cells.measures.status);
  const auto offset = on_first_rank(communicator, cells.offset),
             neighbor = on_first_rank(communicator, cells.neighbor);
  if (rank != 0) return true;
  const RegularTriangulation cgal = regular_triangulation(seeds.view());
  const Inside inside =
      inside_of(simplices_of(cgal.simplices, static_cast<std::size_t>(work.dimension) + 1), seeds);
  Tally tally;
  for (std::size_t r = 0; r < ranks; ++r)
    compare_rows(tally, inside, cgal, shares.ids[r], status[r], offset[r], neighbor[r]);
  const ExchangeReport& report = cells.report;
  std::printf("%dD  %-8s %-3s %9zu %6zu %7d %9llu %10zu %8zu %8.1f  %zu\n", work.dimension,
              name(work.distribution).c_str(), name(work.weights).c_str(), tally.cells, ranks, report.rounds,
              static_cast<unsigned long long>(report.fetched), tally.walls / 2, tally.hidden, spent,
              tally.differences());
  std::fflush(stdout);
  return tally.differences() == 0 && tally.cells == work.n;
}

int run_all(int argc, char** argv) {
  std::size_t n = 1000000;
  int dimension = 3;
  bool redistribute = false;
  CLI::App app("Diagrams of seeds on ranks of MPI against CGAL's regular triangulation, without a tolerance");
  app.add_option("--n", n, "Seeds of a diagram")->capture_default_str();
  app.add_option("--dimension", dimension, "In the plane (2) or in space (3)")->capture_default_str();
  app.add_flag("--redistribute", redistribute,
               "Shared out at random, and sent to others for the computation");
  CLI11_PARSE(app, argc, argv);
  MpiCommunicator communicator(MPI_COMM_WORLD);
  const Device device = Device::choose();
  if (communicator.rank() == 0)
    std::printf("%-3s %-8s %-3s %9s %6s %7s %9s %10s %8s %8s  differences\n", "dim", "seeds", "w", "cells",
                "ranks", "rounds", "fetched", "walls", "hidden", "seconds");
  bool good = true;
  for (const Distribution distribution : {Distribution::white, Distribution::cluster})
    for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
      good = run(communicator, device, {distribution, weights, n, dimension, redistribute}) && good;
  return good ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  return mpi_program("campaign_ranks", argc, argv, run_all);
}
