/// \file
/// A progress bar on stderr.
#pragma once

#include <chrono>
#include <string>

namespace powercell::app {

/// Drawn only on a terminal and after some time; erased when the work is done.
class ProgressBar {
 public:
  /// \param label  text beside the bar   \param silent  never draw
  ProgressBar(std::string label, bool silent);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void update(double fraction);

 private:
  using Clock = std::chrono::steady_clock;
  void wipe();

  std::string label_;
  bool enabled_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace powercell::app
