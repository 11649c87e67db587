#include "lib/report/log.hpp"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <mutex>

#include "lib/base/text.hpp"

namespace powercell {
namespace {

constexpr int no_level = -1;  // below every LogLevel: nothing is logged

int level_of_environment() {
  const char* set = std::getenv("POWERCELL_LOG");
  const std::string_view level = set ? set : "";
  if (level.empty() || level == "off" || level == "none" || level == "0") return no_level;
  if (level == "detail") return static_cast<int>(LogLevel::detail);
  if (level != "info")
    std::fputs("powercell: POWERCELL_LOG is none of 'info', 'detail' and 'off'; using 'info'\n", stderr);
  return static_cast<int>(LogLevel::info);
}

void to_standard_error(LogLevel, std::string_view line) {
  std::fprintf(stderr, "powercell: %.*s\n", static_cast<int>(line.size()), line.data());
}

struct Log {
  std::mutex mutex;
  LogSink sink = to_standard_error;
  const int unset_level = level_of_environment();
  std::atomic<int> most = unset_level;  // lines of levels up to it are written
};

/// Never destroyed, since objects that outlive main may still write.
Log& the_log() {
  static Log& log = *new Log;
  return log;
}

}  // namespace

void set_log(LogSink sink, LogLevel most) {
  Log& log = the_log();
  const std::lock_guard lock(log.mutex);
  log.most = sink ? static_cast<int>(most) : log.unset_level;
  log.sink = sink ? std::move(sink) : to_standard_error;
}

bool is_logged(LogLevel level) noexcept {
  return static_cast<int>(level) <= the_log().most.load(std::memory_order_relaxed);
}

void write_line(LogLevel level, const std::string& line) noexcept {
  try {
    Log& log = the_log();
    const std::lock_guard lock(log.mutex);
    log.sink(level, line);
  } catch (...) {
    // A failure of the sink must not affect the computation.
  }
}

std::string in_seconds(double seconds) {
  return digits(seconds, 3) + " s";
}

}  // namespace powercell
