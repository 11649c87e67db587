/// \file
/// The processes of powercell_mpi.
#pragma once

#include <cstdint>
#include <exception>
#include <powercell/mpi.hpp>
#include <string>
#include <vector>

namespace powercell::app {

class Ranks {
 public:
  int rank() const { return communicator_.rank(); }
  int size() const { return communicator_.size(); }
  bool is_first() const { return rank() == 0; }  ///< which reports, and writes tables
  Communicator& communicator() { return communicator_; }

  /// Does work that may fail on some ranks alone; then throws on all what it threw on the first of them.
  /// \throw WrongUsage, Error
  template <class Work>
  void together(const Work& work) {
    std::exception_ptr thrown;
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
    agree(thrown);
  }

  std::uint64_t sum(std::uint64_t value) const;
  double sum(double value) const;
  /// Ranks that share the memory of this one's machine, with it.
  int on_this_machine() const;

  template <class T>
  void send_to_first(const std::vector<T>& values) const {
    const std::uint64_t count = values.size();
    MPI_Send(&count, 1, MPI_UINT64_T, 0, tag, MPI_COMM_WORLD);
    MPI_Send(values.data(), bytes<T>(count), MPI_BYTE, 0, tag, MPI_COMM_WORLD);
  }
  template <class T>
  void receive(int from, std::vector<T>& values) const {
    std::uint64_t count = 0;
    MPI_Recv(&count, 1, MPI_UINT64_T, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    values.resize(count);
    MPI_Recv(values.data(), bytes<T>(count), MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }

 private:
  static constexpr int tag = 1;

  /// \pre messages are those of some rows, far below 2^31 bytes
  template <class T>
  static int bytes(std::uint64_t count) {
    return static_cast<int>(count * sizeof(T));
  }
  void agree(const std::exception_ptr& thrown) const;

  MpiCommunicator communicator_;
};

}  // namespace powercell::app
