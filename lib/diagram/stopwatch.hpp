/// \file
/// Wall time without compilation. Internal.
#pragma once

#include <chrono>
#include <powercell/device.hpp>

namespace powercell {

/// Measures the wall time since its construction, without the time in which the device compiled kernels.
class Stopwatch {
 public:
  explicit Stopwatch(const Device& device) : device_(device), built_before_(device.build_seconds()) {}
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() -
           (device_.build_seconds() - built_before_);
  }

 private:
  const Device& device_;
  double built_before_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace powercell
