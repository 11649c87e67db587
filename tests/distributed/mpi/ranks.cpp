// Cells of seeds on ranks of MPI, each of which has the diagram of all seeds as its oracle.
#include <doctest/doctest.h>

#include <csignal>
#include <cstdio>
#include <limits>
#include <powercell/mpi.hpp>

#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Compares the cells of this rank. \return the report
ExchangeReport check_rank(MpiCommunicator& communicator, Diagram& diagram, const Shares& shares,
                          bool redistribute = false) {
  const auto rank = static_cast<std::size_t>(communicator.rank());
  CAPTURE(rank);
  const exchange::ShardSeeds own = shares.view()[rank];
  const DistributedCells cells = compute_distributed(communicator, test_device(), diagram.domain(), own.ids,
                                                     own.seeds, {{}, redistribute});
  check_cells(diagram, shares.ids[rank], cells);
  return cells.report;
}

}  // namespace

TEST_CASE("MPI: cells of all weights, along a curve and at random, sent to others or not") {
  MpiCommunicator communicator;
  const auto ranks = static_cast<std::size_t>(communicator.size());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
      INFO(dimension << "D " << name(range));
      const SeedArray seeds = random_seeds(Distribution::white, range, 500, dimension, random);
      Diagram diagram = diagram_of(unit_box(dimension), seeds);
      check_rank(communicator, diagram, along_curve(seeds, ranks));
      const Shares shares = at_random(seeds, ranks, random);
      check_rank(communicator, diagram, shares);
      const ExchangeReport report = check_rank(communicator, diagram, shares, true);
      CHECK((report.redistributed > 0) == (ranks > 1));
    }
}

TEST_CASE("MPI: a periodic cube") {
  MpiCommunicator communicator;
  const auto ranks = static_cast<std::size_t>(communicator.size());
  Random random(test_seed());
  const std::array low{0.0, 0.0, 0.0}, high{1.0, 1.0, 1.0};
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 500, 3, random);
  Diagram diagram = diagram_of(Domain::periodic_box(low, high), seeds);
  check_rank(communicator, diagram, along_curve(seeds, ranks));
  check_rank(communicator, diagram, at_random(seeds, ranks, random), true);
}

TEST_CASE("MPI: ranks without seeds, and more of them than seeds") {
  MpiCommunicator communicator;
  const auto ranks = static_cast<std::size_t>(communicator.size());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 200, 3, random),
                  few = random_seeds(Distribution::white, WeightRange::W1, 2, 3, random);
  Diagram diagram = diagram_of(unit_box(3), seeds), small = diagram_of(unit_box(3), few);
  std::vector<std::size_t> rank(seeds.size());  // all but the last, or the last two, have none
  for (std::size_t i = 0; i < rank.size(); ++i) rank[i] = ranks - 1 - (ranks > 2 ? i % 2 : 0);
  for (const bool redistribute : {false, true}) {
    check_rank(communicator, diagram, {seeds, rank, ranks}, redistribute);
    check_rank(communicator, small, {few, {0, ranks - 1}, ranks}, redistribute);
  }
}

TEST_CASE("MPI: messages in pieces, beside messages of the caller") {
  MpiCommunicator whole;
  const int ranks = whole.size(), rank = whole.rank();
  // The caller waits for any message of the rank before; the library's must not be taken for it.
  int sent = rank, got = -1;
  MPI_Request waiting = MPI_REQUEST_NULL;
  MPI_Irecv(&got, 1, MPI_INT, (rank + ranks - 1) % ranks, MPI_ANY_TAG, MPI_COMM_WORLD, &waiting);

  MpiCommunicator pieces(MPI_COMM_WORLD, 7 * static_cast<std::size_t>(ranks));
  std::vector<Communicator::Message> messages;
  for (int to = 0; to < ranks; ++to)
    messages.emplace_back(static_cast<std::size_t>(13 * rank + 5 * to),
                          static_cast<std::byte>(16 * rank + to));
  const std::vector<Communicator::Message> received = pieces.exchange(messages);
  REQUIRE(received.size() == messages.size());
  for (int from = 0; from < ranks; ++from)
    CHECK(received[static_cast<std::size_t>(from)] ==
          Communicator::Message(static_cast<std::size_t>(13 * from + 5 * rank),
                                static_cast<std::byte>(16 * from + rank)));

  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 200, 2, random);
  Diagram diagram = diagram_of(unit_box(2), seeds);
  const Shares shares = at_random(seeds, static_cast<std::size_t>(ranks), random);
  MpiCommunicator larger(MPI_COMM_WORLD, 1000);
  const ExchangeReport report = check_rank(larger, diagram, shares, true);
  CHECK(report.requests == check_rank(whole, diagram, shares, true).requests);

  MPI_Send(&sent, 1, MPI_INT, (rank + 1) % ranks, 3, MPI_COMM_WORLD);
  MPI_Wait(&waiting, MPI_STATUS_IGNORE);
  CHECK(got == (rank + ranks - 1) % ranks);
}

TEST_CASE("campaign: a message of more than 2^31 bytes" * doctest::skip()) {
  MpiCommunicator communicator;
  const auto ranks = static_cast<std::size_t>(communicator.size()),
             rank = static_cast<std::size_t>(communicator.rank());
  const std::size_t size = (std::size_t{1} << 31) + 12345;
  const auto value = [](std::size_t at) { return static_cast<std::byte>(at * 0x9e3779b97f4a7c15 >> 56); };
  std::vector<Communicator::Message> messages(ranks);
  if (rank == 0) {
    messages.back().resize(size);
    for (std::size_t at = 0; at < size; ++at) messages.back()[at] = value(at);
  }
  messages = communicator.exchange(std::move(messages));
  std::size_t wrong = 0, others = 0;
  for (std::size_t r = 1; r < ranks; ++r) others += messages[r].size();
  for (std::size_t at = 0; at < messages[0].size(); ++at) wrong += messages[0][at] != value(at);
  CHECK(messages[0].size() == (rank + 1 == ranks ? size : 0));
  CHECK(wrong == 0);
  CHECK(others == 0);
}

TEST_CASE("MPI: what is refused on one rank is refused on all, who then compute again") {
  MpiCommunicator communicator;
  const auto rank = static_cast<std::size_t>(communicator.rank()),
             ranks = static_cast<std::size_t>(communicator.size());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 100, 3, random);
  const Shares good = at_random(seeds, ranks, random);
  seeds.coordinate(57, 2) = std::numeric_limits<double>::quiet_NaN();
  const Shares bad(seeds, std::vector<std::size_t>(seeds.size(), ranks - 1), ranks);
  const auto refusal = [&](const Shares& shares, const Domain& domain, const DistributedOptions& options) {
    const exchange::ShardSeeds own = shares.view()[rank];
    try {
      compute_distributed(communicator, test_device(), domain, own.ids, own.seeds, options);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal(bad, unit_box(3), {}).starts_with("seed 57: coordinate z"));
  const std::array low{0.0, 0.0, 0.0}, high{1.0, 1.0, 1.0 + static_cast<double>(rank)};
  CHECK(refusal(good, Domain::box(low, high), {}) ==
        (ranks == 1 ? ""
                    : "ranks 0 and 1 differ in the vertices of the domain; call with the same domain and "
                      "options on all ranks"));
  DistributedOptions options;
  int left = 1;
  if (rank + 1 == ranks) options.diagram.progress = [&left](double) { return --left > 0; };
  const std::string stopped = refusal(good, unit_box(3), options);
  CHECK(stopped.starts_with("rank " + std::to_string(ranks - 1)) == (ranks > 1));
  CHECK(!stopped.empty());
  CHECK(refusal(good, unit_box(3), {}).empty());
}

TEST_CASE("MPI: communicators of some ranks, and what an MpiCommunicator refuses") {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm some = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, rank % 2, -rank, &some);
  {
    MpiCommunicator communicator(some);
    MPI_Comm_free(&some);  // the duplicate stays
    Random random(test_seed() + static_cast<std::uint64_t>(rank % 2));
    const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 100, 2, random);
    Diagram diagram = diagram_of(unit_box(2), seeds);
    check_rank(communicator, diagram,
               at_random(seeds, static_cast<std::size_t>(communicator.size()), random));
    CHECK_THROWS_AS(communicator.exchange({}), Error);
  }
  CHECK_THROWS_AS(MpiCommunicator(MPI_COMM_WORLD, 0), Error);
}

TEST_CASE("killed: one rank in the second round" * doctest::skip()) {
  MpiCommunicator communicator;
  const auto rank = static_cast<std::size_t>(communicator.rank());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
  const Shares shares = at_random(seeds, static_cast<std::size_t>(communicator.size()), random);
  const exchange::ShardSeeds own = shares.view()[rank];
  DistributedOptions options;
  int calls = 0;
  if (rank == 1)
    options.diagram.progress = [&calls](double fraction) {
      if (fraction < 1 || ++calls < 2) return true;
      std::printf("a rank dies\n");
      std::fflush(stdout);
      std::raise(SIGKILL);
      return true;
    };
  compute_distributed(communicator, test_device(), unit_box(3), own.ids, own.seeds, options);
  std::printf("went on\n");
}
