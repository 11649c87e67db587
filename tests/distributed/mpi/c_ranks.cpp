// The communicator of powercell_mpi.h: what it sends and refuses, and the bits of C++.
#include <doctest/doctest.h>
#include <powercell.h>
#include <powercell_mpi.h>

#include <cstring>
#include <limits>
#include <powercell/mpi.hpp>

#include "lib/c_api/communicator.hpp"
#include "lib/c_api/handles.hpp"
#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct CRanks {
  pc_communicator communicator{};
  explicit CRanks(MPI_Comm of = MPI_COMM_WORLD, std::size_t most_bytes = 0) {
    REQUIRE(pc_mpi_communicator_create(of, most_bytes, &communicator) == PC_OK);
  }
  ~CRanks() { pc_mpi_communicator_destroy(&communicator); }
  CRanks(const CRanks&) = delete;
  CRanks& operator=(const CRanks&) = delete;
};

template <class T>
bool has_bits(const T* values, const std::vector<T>& expected) {
  return expected.empty() || std::memcmp(values, expected.data(), expected.size() * sizeof(T)) == 0;
}

/// The cells of this rank from C have the bits of those from C++.
void check_rank_of_c(const pc_communicator& communicator, const Domain& domain, const Shares& shares) {
  const exchange::ShardSeeds own = shares.view()[static_cast<std::size_t>(communicator.rank)];
  MpiCommunicator ranks;
  const DistributedCells expected =
      compute_distributed(ranks, test_device(), domain, own.ids, own.seeds, {{}, true});
  const pc_domain domain_of_c(domain);
  static pc_device device(test_device());
  pc_distributed_options options;
  REQUIRE(pc_distributed_options_init(&options, sizeof options) == PC_OK);
  options.redistribute = 1;
  const pc_distributed_cells* cells = nullptr;
  REQUIRE(pc_compute_distributed(&communicator, &device, &domain_of_c, own.ids.data(),
                                 own.seeds.positions.data(), own.seeds.weights.data(), own.ids.size(),
                                 &options, &cells) == PC_OK);
  REQUIRE(cells->count == own.ids.size());
  REQUIRE(cells->entry_count == expected.neighbor.size());
  CHECK(has_bits(cells->measures->mass, expected.measures.mass));
  CHECK(has_bits(cells->neighbor, expected.neighbor));
  CHECK(has_bits(cells->wall, expected.wall));
  CHECK(cells->report->requests == expected.report.requests);
  pc_distributed_cells_destroy(cells);
}

}  // namespace

TEST_CASE("MPI from C: messages whole and in pieces, beside messages of the caller") {
  int ranks = 0, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  // The caller waits for any message of the rank before; the library's must not be taken for it.
  int got = -1;
  MPI_Request waiting = MPI_REQUEST_NULL;
  MPI_Irecv(&got, 1, MPI_INT, (rank + ranks - 1) % ranks, MPI_ANY_TAG, MPI_COMM_WORLD, &waiting);
  for (const std::size_t most : {std::size_t{0}, 7 * static_cast<std::size_t>(ranks),
                                 static_cast<std::size_t>(ranks), std::numeric_limits<std::size_t>::max()}) {
    CAPTURE(most);
    const CRanks own(MPI_COMM_WORLD, most);
    CHECK(own.communicator.rank == rank);
    CHECK(own.communicator.size == ranks);
    std::vector<Communicator::Message> messages;
    for (int to = 0; to < ranks; ++to)
      messages.emplace_back(static_cast<std::size_t>(13 * rank + 5 * to),
                            static_cast<std::byte>(16 * rank + to));
    const std::vector<Communicator::Message> received =
        c_api::CallerCommunicator(&own.communicator).exchange(messages);
    REQUIRE(received.size() == messages.size());
    for (int from = 0; from < ranks; ++from)
      CHECK(received[static_cast<std::size_t>(from)] ==
            Communicator::Message(static_cast<std::size_t>(13 * from + 5 * rank),
                                  static_cast<std::byte>(16 * from + rank)));
  }
  MPI_Send(&rank, 1, MPI_INT, (rank + 1) % ranks, 3, MPI_COMM_WORLD);
  MPI_Wait(&waiting, MPI_STATUS_IGNORE);
  CHECK(got == (rank + ranks - 1) % ranks);
}

TEST_CASE("MPI from C: the bits of C++, with messages whole and in pieces") {
  int ranks = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  Random random(test_seed());
  const CRanks whole, pieces(MPI_COMM_WORLD, 1000);
  for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
    const SeedArray seeds = random_seeds(Distribution::white, range, 300, 3, random);
    const Shares shares = at_random(seeds, static_cast<std::size_t>(ranks), random);
    check_rank_of_c(whole.communicator, unit_box(3), shares);
    check_rank_of_c(pieces.communicator, unit_box(3), shares);
  }
}

TEST_CASE("MPI from C: where one rank has no memory for a message, all end and can exchange again") {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const CRanks own;
  pc_mailbox mailbox(static_cast<std::size_t>(own.communicator.size));
  const std::vector<pc_message> messages(mailbox.messages.size(), {"four", 4});
  void* room = nullptr;  // as if there were none: it is taken already
  if (rank == 0) REQUIRE(pc_mailbox_room(&mailbox, 0, 4, &room) == PC_OK);
  CHECK(own.communicator.exchange(messages.data(), &mailbox, own.communicator.user) == 0);
  CHECK((mailbox.failure != nullptr) == (rank == 0));
  pc_mailbox other(mailbox.messages.size());
  CHECK(own.communicator.exchange(messages.data(), &other, own.communicator.user) == 1);
  for (const Communicator::Message& message : other.messages)
    CHECK((message.size() == 4 && std::memcmp(message.data(), "four", 4) == 0));
}

TEST_CASE("MPI from C: an error of one rank is that of all, communicators of some ranks, and refusals") {
  int rank = 0, ranks = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  {
    const CRanks own;
    static pc_device device(test_device());
    const pc_domain domain(unit_box(3));
    const pc_distributed_cells* cells = nullptr;
    CHECK(pc_compute_distributed(&own.communicator, rank + 1 == ranks ? nullptr : &device, &domain, nullptr,
                                 nullptr, nullptr, 0, nullptr, &cells) == PC_INVALID_ARGUMENT);
    CHECK(pc_last_error() ==
          (ranks == 1 ? std::string() : "rank " + std::to_string(ranks - 1) + ": ") + "device is NULL");
  }
  MPI_Comm some = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, rank % 2, -rank, &some);
  {
    const CRanks own(some);
    int size = 0;
    MPI_Comm_size(some, &size);
    MPI_Comm_free(&some);  // the duplicate stays
    CHECK(own.communicator.size == size);
    CHECK(c_api::CallerCommunicator(&own.communicator)
              .exchange(std::vector<Communicator::Message>(static_cast<std::size_t>(size)))
              .size() == static_cast<std::size_t>(size));
  }
  pc_communicator refused;
  CHECK(pc_mpi_communicator_create(MPI_COMM_WORLD, 0, nullptr) == PC_INVALID_ARGUMENT);
  if (ranks > 1) {
    CHECK(pc_mpi_communicator_create(MPI_COMM_WORLD, 1, &refused) == PC_INVALID_ARGUMENT);
    CHECK(std::string(pc_last_error()) ==
          "a communicator over MPI needs at least a byte for each rank at a time");
    pc_mpi_communicator_destroy(&refused);
    MPI_Comm half = MPI_COMM_NULL, between = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank == 0 ? 0 : 1, 0, &half);
    MPI_Intercomm_create(half, 0, MPI_COMM_WORLD, rank == 0 ? 1 : 0, 5, &between);
    CHECK(pc_mpi_communicator_create(between, 0, &refused) == PC_INVALID_ARGUMENT);
    CHECK(std::string(pc_last_error()) == "a communicator over MPI needs an intracommunicator");
    MPI_Comm_free(&between);
    MPI_Comm_free(&half);
  }
  pc_mpi_communicator_destroy(nullptr);
}

TEST_CASE("campaign: a message of more than 2^31 bytes, from C" * doctest::skip()) {
  const CRanks own;
  const auto ranks = static_cast<std::size_t>(own.communicator.size),
             rank = static_cast<std::size_t>(own.communicator.rank);
  const std::size_t size = (std::size_t{1} << 31) + 12345;
  const auto value = [](std::size_t at) { return static_cast<std::byte>(at * 0x9e3779b97f4a7c15 >> 56); };
  std::vector<Communicator::Message> messages(ranks);
  if (rank == 0) {
    messages.back().resize(size);
    for (std::size_t at = 0; at < size; ++at) messages.back()[at] = value(at);
  }
  messages = c_api::CallerCommunicator(&own.communicator).exchange(std::move(messages));
  std::size_t wrong = 0;
  for (std::size_t at = 0; at < messages[0].size(); ++at) wrong += messages[0][at] != value(at);
  CHECK(messages[0].size() == (rank + 1 == ranks ? size : 0));
  CHECK(wrong == 0);
}
