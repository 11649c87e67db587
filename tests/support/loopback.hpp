/// \file
/// Ranks that are threads of this process.
#pragma once

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <powercell/communicator.hpp>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace powercell::test {

/// What the threads share. A rank that waits for one that has ended, or for longer than a minute, fails.
class Loopback {
 public:
  using Message = Communicator::Message;
  explicit Loopback(std::size_t ranks) : letters_(ranks, std::vector<Message>(ranks)) {}

  std::vector<Message> exchange(std::size_t rank, std::vector<Message> messages) {
    if (messages.size() != letters_.size()) throw std::logic_error("a message for each rank is needed");
    std::unique_lock lock(mutex_);
    letters_[rank] = std::move(messages);
    meet(lock);
    std::vector<Message> received;
    for (std::vector<Message>& from : letters_) received.push_back(std::move(from[rank]));
    meet(lock);  // so that nobody writes the next messages before all have these
    return received;
  }
  std::size_t ranks() const { return letters_.size(); }
  void leave() {
    const std::lock_guard lock(mutex_);
    has_left_ = true;
    all_.notify_all();
  }

 private:
  void meet(std::unique_lock<std::mutex>& lock) {
    const std::size_t meeting = meetings_;
    if (++here_ == ranks()) {
      here_ = 0;
      ++meetings_;
      all_.notify_all();
      return;
    }
    const bool in_time =
        all_.wait_for(lock, std::chrono::minutes(1), [&] { return meetings_ != meeting || has_left_; });
    if (meetings_ == meeting)
      throw std::runtime_error(in_time ? "a rank has ended that others wait for"
                                       : "a rank waits for a minute");
  }

  std::mutex mutex_;
  std::condition_variable all_;
  std::vector<std::vector<Message>> letters_;  // by sender and receiver
  std::size_t here_ = 0, meetings_ = 0;
  bool has_left_ = false;
};

class LoopbackCommunicator : public Communicator {
 public:
  LoopbackCommunicator(Loopback& loopback, std::size_t rank) : loopback_(loopback), rank_(rank) {}
  int rank() const override { return static_cast<int>(rank_); }
  int size() const override { return static_cast<int>(loopback_.ranks()); }
  std::vector<Message> exchange(std::vector<Message> messages) override {
    return loopback_.exchange(rank_, std::move(messages));
  }

 private:
  Loopback& loopback_;
  std::size_t rank_;
};

/// Calls work(communicator) on each rank, in threads. \return by rank: what it threw, or null
template <class Work>
std::vector<std::exception_ptr> on_ranks(std::size_t ranks, const Work& work) {
  Loopback loopback(ranks);
  std::vector<std::exception_ptr> thrown(ranks);
  std::vector<std::thread> threads;
  for (std::size_t rank = 0; rank < ranks; ++rank)
    threads.emplace_back([&, rank] {
      try {
        LoopbackCommunicator communicator(loopback, rank);
        work(communicator);
      } catch (...) {
        thrown[rank] = std::current_exception();
      }
      loopback.leave();
    });
  for (std::thread& thread : threads) thread.join();
  return thrown;
}

}  // namespace powercell::test
