/// \file
/// How the ranks of a distributed computation reach each other: an interface for any transport. For MPI see
/// powercell/mpi.hpp.
#pragma once

#include <cstddef>
#include <powercell/export.hpp>
#include <vector>

namespace powercell {

/// A rank of several that compute together: processes, or threads of one. The library calls exchange() in the
/// thread that called the library, on all ranks equally often and in the same order.
class POWERCELL_API Communicator {
 public:
  using Message = std::vector<std::byte>;

  Communicator() = default;
  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  virtual ~Communicator();

  virtual int rank() const = 0;  ///< from 0; stays the same
  virtual int size() const = 0;  ///< the number of ranks; stays the same
  /// Sends a message to each rank and returns when all that are sent to this one are here. All ranks call it.
  /// It must not wait for ever for a rank that is gone, but throw or end the program.
  /// \param messages  size() of them, by the rank that they go to, this one included; some are empty, and
  ///        some may be longer than 2^31 bytes
  /// \return size() messages, by the rank that they come from
  virtual std::vector<Message> exchange(std::vector<Message> messages) = 0;
};

}  // namespace powercell
