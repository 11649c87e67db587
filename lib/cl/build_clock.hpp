/// \file
/// The time that compilers of kernels take.
#pragma once

#include <chrono>
#include <ctime>

namespace powercell::cl {

class Context;

/// One compilation, from construction to `done`. Without `done`, because the compiler failed or a program
/// came from a cache, its time does not count.
class BuildClock {
 public:
  BuildClock();
  ~BuildClock();
  BuildClock(const BuildClock&) = delete;
  BuildClock& operator=(const BuildClock&) = delete;

  double seconds() const;
  /// Counts the time so far for the context and in kernel_builds().
  /// \param execution  seconds of it in which the kernel ran
  /// \return the seconds counted
  double done(Context& context, double execution = 0) const;

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::clock_t processor_start_ = std::clock();
};

}  // namespace powercell::cl
