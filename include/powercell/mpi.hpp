/// \file
/// A Communicator over MPI. In this header alone: the libraries of powercell do not know of MPI, and any MPI
/// of at least version 3 can be used with them. CMake: find_package(powercell COMPONENTS mpi) has
/// powercell::mpi.
#pragma once

// Of the C++ bindings, which MPI 3 has removed, some headers still have remains that cause warnings.
#ifndef OMPI_SKIP_MPICXX
#define OMPI_SKIP_MPICXX 1
#endif
#ifndef MPICH_SKIP_MPICXX
#define MPICH_SKIP_MPICXX 1
#endif
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <powercell/communicator.hpp>
#include <powercell/error.hpp>
#include <utility>
#include <vector>

namespace powercell {

/// The ranks of an MPI communicator. MPI is called in the thread that calls the library, so
/// MPI_THREAD_FUNNELED is enough where that is the thread of MPI_Init_thread. An error of MPI ends the job,
/// as others would wait for ever.
class MpiCommunicator : public Communicator {
 public:
  /// Duplicates the communicator, so that messages of the library never meet those of the caller: all its
  /// ranks must make theirs at the same time.
  /// \param most_bytes  that a rank sends in one call of MPI_Alltoallv; longer messages are sent in pieces.
  ///        So many bytes are taken in memory twice. The same on all ranks.
  /// \throw Error invalid_argument (MPI is not running, an intercommunicator, less than a byte for each rank)
  explicit MpiCommunicator(MPI_Comm communicator = MPI_COMM_WORLD, std::size_t most_bytes = 1 << 28)
      : most_bytes_(std::min<std::size_t>(most_bytes, std::numeric_limits<int>::max())) {
    int is_running = 0, is_over = 0;
    MPI_Initialized(&is_running);
    MPI_Finalized(&is_over);
    if (is_running == 0 || is_over != 0)
      throw Error(ErrorCode::invalid_argument,
                  "an MpiCommunicator is made between MPI_Init and MPI_Finalize");
    int is_between = 0;
    MPI_Comm_test_inter(communicator, &is_between);
    if (is_between != 0)
      throw Error(ErrorCode::invalid_argument, "an MpiCommunicator needs an intracommunicator");
    MPI_Comm_size(communicator, &size_);
    if (most_bytes_ < static_cast<std::size_t>(size_))
      throw Error(ErrorCode::invalid_argument,
                  "an MpiCommunicator needs at least a byte for each rank at a time");
    MPI_Comm_dup(communicator, &own_);
    MPI_Comm_set_errhandler(own_, MPI_ERRORS_ARE_FATAL);
    MPI_Comm_rank(own_, &rank_);
  }
  MpiCommunicator(const MpiCommunicator&) = delete;
  MpiCommunicator& operator=(const MpiCommunicator&) = delete;
  /// After MPI_Finalize there is nothing left to free.
  ~MpiCommunicator() override {
    int is_over = 0;
    MPI_Finalized(&is_over);
    if (is_over == 0) MPI_Comm_free(&own_);
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  std::vector<Message> exchange(std::vector<Message> messages) override {
    const auto ranks = static_cast<std::size_t>(size_);
    if (messages.size() != ranks)
      throw Error(ErrorCode::invalid_argument, "an MpiCommunicator needs a message for each rank");
    std::vector<std::uint64_t> sizes(ranks), coming(ranks);
    for (std::size_t r = 0; r < ranks; ++r) sizes[r] = messages[r].size();
    MPI_Alltoall(sizes.data(), 1, MPI_UINT64_T, coming.data(), 1, MPI_UINT64_T, own_);
    std::uint64_t longest = *std::max_element(sizes.begin(), sizes.end());
    MPI_Allreduce(MPI_IN_PLACE, &longest, 1, MPI_UINT64_T, MPI_MAX, own_);

    std::vector<Message> received(ranks);
    for (std::size_t r = 0; r < ranks; ++r) received[r].reserve(coming[r]);
    // Counts and places within a call of MPI are int.
    const std::uint64_t most = most_bytes_ / ranks;
    for (std::uint64_t begin = 0; begin < longest; begin += most)
      exchange_piece(begin, most, messages, sizes, coming, received);
    return received;
  }

 private:
  /// The bytes of a piece for each rank, and where they begin in a buffer.
  struct Layout {
    std::vector<int> count, place;
    int bytes = 0;

    Layout(const std::vector<std::uint64_t>& sizes, std::uint64_t begin, std::uint64_t most) {
      for (const std::uint64_t size : sizes) {
        count.push_back(static_cast<int>(size > begin ? std::min(size - begin, most) : 0));
        place.push_back(bytes);
        bytes += count.back();
      }
    }
  };

  void exchange_piece(std::uint64_t begin, std::uint64_t most, const std::vector<Message>& messages,
                      const std::vector<std::uint64_t>& sizes, const std::vector<std::uint64_t>& coming,
                      std::vector<Message>& received) {
    const Layout out(sizes, begin, most), in(coming, begin, most);
    Message sent, got(static_cast<std::size_t>(in.bytes));
    sent.reserve(static_cast<std::size_t>(out.bytes));
    for (std::size_t r = 0; r < messages.size(); ++r) {
      if (out.count[r] == 0) continue;
      const std::byte* const from = messages[r].data() + begin;
      sent.insert(sent.end(), from, from + out.count[r]);
    }
    MPI_Alltoallv(sent.data(), out.count.data(), out.place.data(), MPI_BYTE, got.data(), in.count.data(),
                  in.place.data(), MPI_BYTE, own_);
    for (std::size_t r = 0; r < received.size(); ++r)
      received[r].insert(received[r].end(), got.begin() + in.place[r],
                         got.begin() + in.place[r] + in.count[r]);
  }

  std::size_t most_bytes_;
  MPI_Comm own_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
};

}  // namespace powercell
