/// \file
/// Ranks whose exchange is a function of C.
#pragma once

#include <powercell/c/communicator.h>

#include <exception>
#include <powercell/communicator.hpp>
#include <vector>

/// The messages to this rank, while they come in.
struct pc_mailbox {
  explicit pc_mailbox(std::size_t ranks) : messages(ranks), has_room(ranks) {}
  std::vector<powercell::Communicator::Message> messages;  // by the rank that they come from
  std::vector<bool> has_room;
  std::exception_ptr failure;  // of the first call that failed
};

namespace powercell::c_api {

/// A communicator of the caller.
class CallerCommunicator : public Communicator {
 public:
  /// Copies it.
  /// \throw Error invalid_argument (NULL, its size as a struct, without a function)
  explicit CallerCommunicator(const pc_communicator* given);
  int rank() const override { return given_.rank; }
  int size() const override { return given_.size; }
  std::vector<Message> exchange(std::vector<Message> messages) override;

 private:
  pc_communicator given_;
};

/// Within a catch block: throws the exception on all ranks, the others of which are in their first exchange.
[[noreturn]] void throw_on_all(Communicator& communicator);

/// Makes C++ of the arguments of a call, before its first exchange: ranks on which that works must not wait
/// for ever for those on which it throws.
template <class Read>
auto read_on_all(Communicator& communicator, const Read& read) {
  try {
    return read();
  } catch (...) {
    throw_on_all(communicator);
  }
}

}  // namespace powercell::c_api
