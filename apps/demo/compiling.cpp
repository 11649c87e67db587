#include "apps/demo/compiling.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <powercell/powercell.hpp>

#include "apps/demo/page.hpp"
#include "apps/progress.hpp"

namespace powercell::app {
namespace {

bool log_is_wanted() {
  const char* wish = std::getenv("POWERCELL_LOG");
  const std::string_view level = wish ? wish : "";
  return level == "info" || level == "detail";
}

}  // namespace

Compiling::Compiling(Progress& progress, std::string device, std::size_t programs, bool silent)
    : progress_(progress),
      device_(std::move(device)),
      all_(programs),
      silent_(silent),
      follows_(!log_is_wanted()) {
  if (!follows_) return;
  set_log([this](LogLevel, std::string_view line) {
    if (line.find(" built in ") == std::string_view::npos) return;
    ++built_;
    say();
  });
}

Compiling::~Compiling() {
  if (follows_) set_log({});
}

// Called by one thread at a time, by that of the log.
void Compiling::say() {
  // Larger variants for cells of many faces are built only where such cells occur.
  progress_.building(fmt::format("compiling kernels, {} of {}, once for {}", built_.load(),
                                 std::max(all_, built_.load()), device_));
  if (silent_ || said_ || isatty(STDERR_FILENO) != 0 || kernel_builds().seconds < noticeable_build) return;
  said_ = true;
  progress_.aside([&] {
    fmt::print("compiling kernels for {}, once: later runs find them in the cache\n", device_);
    std::fflush(stdout);
  });
}

}  // namespace powercell::app
