#include "lib/base/rank_mailbox.hpp"

#include <algorithm>
#include <utility>

namespace powercell {
namespace {

constexpr std::byte fine{0}, has_failed{1};

Bytes packed_fault(ErrorCode code, const std::string& what) {
  return packed(std::vector<std::int32_t>{static_cast<std::int32_t>(code)},
                std::vector<char>(what.begin(), what.end()));
}

/// Takes the last byte off each message.
/// \return by rank: whether it has failed; fewer if messages are lost
std::vector<bool> take_marks(std::vector<Bytes>& received) {
  std::vector<bool> failed;
  for (Bytes& message : received) {
    if (message.empty()) break;
    failed.push_back(message.back() == has_failed);
    message.pop_back();
  }
  return failed;
}

/// The error of the first rank that has failed.
/// \pre there is one
Error first_error(const std::vector<Bytes>& messages, const std::vector<bool>& failed) {
  const auto first = static_cast<std::size_t>(std::find(failed.begin(), failed.end(), true) - failed.begin());
  std::vector<std::int32_t> code;
  std::vector<char> what;
  unpack(messages[first], code, what);
  std::string text(what.begin(), what.end());
  // What all ranks say needs no rank that says it.
  const bool all = std::all_of(messages.begin(), messages.end(),
                               [&](const Bytes& message) { return message == messages[first]; });
  if (!all) text = "rank " + std::to_string(first) + ": " + text;
  return {static_cast<ErrorCode>(code.at(0)), text};
}

}  // namespace

RankMailbox::RankMailbox(Communicator& communicator) : communicator_(communicator) {
  const int rank = communicator.rank(), size = communicator.size();
  if (rank < 0 || rank >= size)
    throw Error(ErrorCode::invalid_argument, "a communicator says that it is rank " + std::to_string(rank) +
                                                 " of " + std::to_string(size));
}

std::vector<Bytes> RankMailbox::exchange(std::vector<Bytes> messages) {
  for (Bytes& message : messages) message.push_back(fine);
  is_over_ = true;  // unless it comes to its end
  std::vector<Bytes> received = communicator_.exchange(std::move(messages));
  const std::vector<bool> failed = take_marks(received);
  if (failed.size() != static_cast<std::size_t>(shards()))
    throw Error(ErrorCode::invalid_argument, "a communicator has lost messages: of " +
                                                 std::to_string(shards()) + " ranks it gave " +
                                                 std::to_string(failed.size()));
  if (std::find(failed.begin(), failed.end(), true) != failed.end()) throw first_error(received, failed);
  is_over_ = false;
  return received;
}

Error RankMailbox::failed_together(ErrorCode code, const std::string& what) {
  Bytes message = packed_fault(code, what);
  message.push_back(has_failed);
  is_over_ = true;
  std::vector<Bytes> received =
      communicator_.exchange(std::vector<Bytes>(static_cast<std::size_t>(shards()), message));
  const std::vector<bool> failed = take_marks(received);
  if (failed.size() != static_cast<std::size_t>(shards())) return {code, what};  // messages are lost too
  return first_error(received, failed);
}

std::vector<Mailbox::Letters> RankMailbox::deliver(std::vector<Letters> letters) {
  std::vector<Bytes> messages(static_cast<std::size_t>(shards()));
  for (Letters& own : letters)
    for (auto& [to, letter] : own) messages[static_cast<std::size_t>(to)] = std::move(letter);
  messages = exchange(std::move(messages));
  std::vector<Letters> delivered(1);
  for (std::size_t from = 0; from < messages.size(); ++from)
    if (!messages[from].empty()) delivered[0][static_cast<int>(from)] = std::move(messages[from]);
  return delivered;
}

std::vector<Bytes> RankMailbox::share(std::vector<Bytes> own) {
  return exchange(std::vector<Bytes>(static_cast<std::size_t>(shards()), own.at(0)));
}

}  // namespace powercell
