/// \file
/// Wall time without compilation.
#pragma once

#include <chrono>
#include <powercell/device.hpp>

#include "lib/cl/context.hpp"

namespace powercell {

/// Measures the wall time since its construction, without the time in which the device, the first of a group,
/// compiled kernels.
class Stopwatch {
 public:
  explicit Stopwatch(const Device& device)
      : device_(device), built_before_(device.context()->build_seconds()) {}
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() -
           (device_.context()->build_seconds() - built_before_);
  }

 private:
  const Device& device_;
  double built_before_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace powercell
