#include "python/src/call.hpp"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <powercell/error.hpp>
#include <powercell/log.hpp>
#include <thread>

namespace powercell::python {
namespace {

std::atomic<int> in_flight = 0;
pid_t counted_in = 0;  // a forked process has none of the threads that were counted
std::atomic<bool> ends = false;
std::thread::id ending_thread;  // written before `ends`

constexpr std::chrono::milliseconds while_ending(1);

/// What Python 3.14 does with threads that come back when it ends; earlier ones end them in ways that C++
/// does not survive.
[[noreturn]] void hang() {
  const nb::gil_scoped_release released;
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace

InFlight::InFlight() {
  if (ends && std::this_thread::get_id() == ending_thread)
    throw Error(ErrorCode::unsupported, "powercell cannot be called when the interpreter ends");
  if (ends) hang();
  if (counted_in != getpid()) in_flight = 0;
  counted_in = getpid();
  ++in_flight;
}

InFlight::~InFlight() {
  --in_flight;
  if (ends) hang();
}

bool InFlight::ending() {
  return ends;
}

void InFlight::end_all() {
  ending_thread = std::this_thread::get_id();
  ends = true;
  if (counted_in != getpid()) return;
  const nb::gil_scoped_release released;
  while (in_flight > 0) std::this_thread::sleep_for(while_ending);
  set_log({});
}

std::shared_ptr<nb::object> shared(nb::object object) {
  return {new nb::object(std::move(object)), [](nb::object* last) {
            const nb::gil_scoped_acquire acquired;
            delete last;
          }};
}

const Call*& Call::innermost() {
  static thread_local const Call* call = nullptr;
  return call;
}

void Call::require_not_within(const void* owner) const {
  for (const Call* call = outer_; call; call = call->outer_)
    if (call->owner_ == owner)
      throw Error(
          ErrorCode::invalid_argument,
          "an object is called from within its own progress or density function, while it computes: use "
          "another object there, or this one afterwards");
}

}  // namespace powercell::python
