/// \file
/// Wall time without compilation.
#pragma once

#include <chrono>
#include <powercell/device.hpp>
#include <utility>

namespace powercell {

/// Measures laps of wall time, without the time in which kernels were compiled.
class WorkClock {
 public:
  /// Seconds since the last call, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double built = kernel_builds().seconds;
    const double all = std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    return all - (built - std::exchange(built_, built));
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  double built_ = kernel_builds().seconds;
};

}  // namespace powercell
