#include "lib/c_api/communicator.hpp"

#include <string>
#include <utility>

#include "lib/base/rank_mailbox.hpp"
#include "lib/c_api/options.hpp"

namespace powercell::c_api {
namespace {

void* room_in(pc_mailbox& mailbox, int from, std::size_t size) {
  const auto rank = static_cast<std::size_t>(from);
  if (from < 0 || rank >= mailbox.messages.size())
    throw Error(ErrorCode::invalid_argument, "a message comes from rank " + std::to_string(from) + " of " +
                                                 std::to_string(mailbox.messages.size()));
  if (mailbox.has_room[rank])
    throw Error(ErrorCode::invalid_argument,
                "two messages come from rank " + std::to_string(from) + " in one exchange");
  mailbox.has_room[rank] = true;
  mailbox.messages[rank].resize(size);
  return size == 0 ? nullptr : mailbox.messages[rank].data();
}

}  // namespace

CallerCommunicator::CallerCommunicator(const pc_communicator* given)
    : given_(current(&checked(given, "communicator"), pc_communicator{}, "pc_communicator")) {
  require(given_.exchange != nullptr, "a communicator needs a function that exchanges messages");
}

std::vector<Communicator::Message> CallerCommunicator::exchange(std::vector<Message> messages) {
  constexpr const char* name = "the function that exchanges messages";
  std::vector<pc_message> sent;
  sent.reserve(messages.size());
  for (const Message& message : messages)
    sent.push_back({message.empty() ? nullptr : message.data(), message.size()});
  pc_mailbox mailbox(messages.size());
  const int answer = call_back(name, [&] { return given_.exchange(sent.data(), &mailbox, given_.user); });
  if (mailbox.failure) std::rethrow_exception(mailbox.failure);
  require_went_on(answer, name);
  return std::move(mailbox.messages);
}

void throw_on_all(Communicator& communicator) {
  RankMailbox mailbox(communicator);
  mailbox.together([]() -> int { throw; });
  std::terminate();  // not reached: that throws
}

}  // namespace powercell::c_api

using namespace powercell;
using namespace powercell::c_api;

pc_status pc_communicator_init(pc_communicator* communicator, size_t struct_size) {
  return init(communicator, struct_size, pc_communicator{}, "pc_communicator");
}

pc_status pc_mailbox_room(pc_mailbox* mailbox, int from, size_t size, void** room) {
  return guarded([&] {
    pc_mailbox& in = checked(mailbox, "mailbox");
    try {
      result_at(room);
      *room = room_in(in, from, size);
    } catch (...) {
      if (!in.failure) in.failure = std::current_exception();
      throw;
    }
  });
}
