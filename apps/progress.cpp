#include "apps/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace powercell::app {
namespace {

constexpr double patience = 0.7;  // seconds before the first drawing
constexpr double period = 0.1;    // seconds between two drawings
constexpr int width = 40;

double seconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double>(d).count();
}

}  // namespace

ProgressBar::ProgressBar(std::string label, bool silent)
    : label_(std::move(label)), enabled_(!silent && isatty(STDERR_FILENO) != 0) {}

ProgressBar::~ProgressBar() {
  wipe();
}

void ProgressBar::update(double fraction) {
  if (!enabled_) return;
  const Clock::time_point now = Clock::now();
  if (fraction <= 0 && !drawn_) start_ = now;  // the same diagram is asked again
  if (fraction >= 1) return wipe();
  if (seconds(now - start_) < patience || seconds(now - last_) < period) return;
  last_ = now;
  drawn_ = true;
  const int full = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
  fmt::print(stderr, "\r{} [{:=<{}}{: <{}}] {:3.0f} %", label_, "", full, "", width - full, 100 * fraction);
  std::fflush(stderr);
}

void ProgressBar::wipe() {
  if (!drawn_) return;
  fmt::print(stderr, "\r{: <{}}\r", "", label_.size() + width + 12);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace powercell::app
