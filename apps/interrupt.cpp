#include "apps/interrupt.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <powercell/error.hpp>

#include "apps/io/atomic_file.hpp"

namespace powercell::app {
namespace {

constexpr int exit_code = 130;  // as shells report a command ended by Ctrl-C
std::atomic<bool> asked{false};
std::atomic<int> computations{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "used in a signal handler");

extern "C" void on_signal(int) {
  if (computations.load() > 0 && !asked.exchange(true)) return;
  io::remove_unfinished_files();
  constexpr char message[] = "powercell: error: interrupted\n";
  // A failed write cannot be reported.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message, sizeof(message) - 1);
  _exit(exit_code);
}

}  // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    // The parent may have ignored the signal (nohup).
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  // A closed pipe ('powercell devices | head -1') makes a write fail instead of ending the process.
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() noexcept {
  return asked.load();
}

void stop_if_interrupted() {
  if (interrupted()) throw Error(ErrorCode::interrupted, "interrupted");
}

Computing::Computing() noexcept {
  computations.fetch_add(1);
}
Computing::~Computing() {
  computations.fetch_sub(1);
}

}  // namespace powercell::app
