/// \file
/// A progress bar on stderr.
#pragma once

#include <chrono>
#include <string>

namespace powercell::app {

/// Drawn only on a terminal and only once the work has taken a while; wiped when the work is done.
class ProgressBar {
 public:
  /// \param what  the word beside the bar   \param silent  never draw
  ProgressBar(std::string what, bool silent);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(double fraction);

 private:
  using Clock = std::chrono::steady_clock;
  void wipe();

  std::string what_;
  bool enabled_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace powercell::app
