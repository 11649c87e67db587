/// \file
/// Calls of the C interface on ranks that are threads.
#pragma once

#include <stdexcept>

#include "lib/c_api/handles.hpp"
#include "tests/c_api/handles.hpp"
#include "tests/distributed/ranks.hpp"

namespace powercell::c_ranks_test {

using namespace powercell::test;
using Cells = c_api_test::Owned<const pc_distributed_cells, pc_distributed_cells_destroy>;

/// The device of the C++ tests: results of C and of C++ are to be the same bits.
inline pc_device* device_of_tests() {
  static pc_device device(test_device());
  return &device;
}

/// A rank that is a thread. Its exchange fails when `left` of them were done.
struct Rank {
  enum class Ending { stops, throws, throws_no_exception, loses_a_message, sends_twice, comes_from_nowhere };

  Communicator& threads;
  int left = std::numeric_limits<int>::max();
  Ending ending = Ending::stops;
};

inline void receive(pc_mailbox* mailbox, int from, const Communicator::Message& message) {
  void* room = nullptr;
  if (pc_mailbox_room(mailbox, from, message.size(), &room) != PC_OK) throw std::logic_error(pc_last_error());
  std::copy(message.begin(), message.end(), static_cast<std::byte*>(room));
}

/// What the rank does instead of an exchange, or at the end of one. \return its answer
inline int end_exchange(const Rank& rank, pc_mailbox* mailbox) {
  void* room = nullptr;
  switch (rank.ending) {
    case Rank::Ending::stops:
      return 0;
    case Rank::Ending::throws:
      throw std::runtime_error("the cable is cut");
    case Rank::Ending::throws_no_exception:
      throw 7;
    case Rank::Ending::loses_a_message:
      return 1;
    case Rank::Ending::sends_twice:
      pc_mailbox_room(mailbox, 0, 1, &room);
      pc_mailbox_room(mailbox, 0, 1, &room);
      return 1;
    case Rank::Ending::comes_from_nowhere:
      pc_mailbox_room(mailbox, rank.threads.size(), 1, &room);
      return 0;
  }
  return 0;
}

inline int exchange_in_threads(const pc_message* messages, pc_mailbox* mailbox, void* user) {
  Rank& rank = *static_cast<Rank*>(user);
  if (--rank.left < 0) return end_exchange(rank, mailbox);
  std::vector<Communicator::Message> sent;
  for (int to = 0; to < rank.threads.size(); ++to) {
    const auto* const bytes = static_cast<const std::byte*>(messages[to].bytes);
    sent.emplace_back(bytes, bytes + messages[to].size);
  }
  const std::vector<Communicator::Message> received = rank.threads.exchange(std::move(sent));
  for (int from = 0; from < rank.threads.size(); ++from)
    if (!received[static_cast<std::size_t>(from)].empty())
      receive(mailbox, from, received[static_cast<std::size_t>(from)]);
  return 1;
}

inline pc_communicator communicator_of(Rank& rank) {
  pc_communicator communicator;
  REQUIRE(pc_communicator_init(&communicator, sizeof communicator) == PC_OK);
  communicator.rank = rank.threads.rank();
  communicator.size = rank.threads.size();
  communicator.exchange = exchange_in_threads;
  communicator.user = &rank;
  return communicator;
}

/// Runs work(rank) on all ranks, in threads, and rethrows what the first threw that did.
template <class Work>
void on_c_ranks(std::size_t count, const Work& work) {
  device_of_tests();
  for (const std::exception_ptr& thrown : on_ranks(count, [&](Communicator& threads) {
         Rank rank{threads};
         work(rank);
       }))
    if (thrown) std::rethrow_exception(thrown);
}

/// What a rank gives pc_compute_distributed().
struct Arguments {
  pc_communicator communicator;
  const pc_device* device;
  const pc_domain* domain;
  const std::uint64_t* ids;
  const double *positions, *weights;
  std::size_t count;
  const pc_distributed_options* options = nullptr;

  Arguments(Rank& rank, const pc_domain& in, const Shares& shares)
      : communicator(communicator_of(rank)), device(device_of_tests()), domain(&in) {
    const auto own = static_cast<std::size_t>(communicator.rank);
    ids = shares.ids[own].data();
    positions = shares.positions[own].data();
    weights = shares.weights[own].data();
    count = shares.ids[own].size();
  }
  pc_status compute(const pc_distributed_cells** cells) const {
    return pc_compute_distributed(&communicator, device, domain, ids, positions, weights, count, options,
                                  cells);
  }
};

}  // namespace powercell::c_ranks_test
