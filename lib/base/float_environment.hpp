/// \file
/// The floating-point environment that the library computes in, whatever the caller's.
#pragma once

#include <cfenv>

namespace powercell {

/// While one lives its thread rounds to nearest, keeps subnormal numbers and traps nothing, as the exact
/// decisions and the promise of equal bits need. Each function that a host program calls and that computes
/// has one first. Threads that are started meanwhile, those of OpenCL drivers among them, inherit it.
class FloatEnvironment {
 public:
  FloatEnvironment() {
    if (is_default()) return;
    std::fegetenv(&callers_);
    std::fesetenv(FE_DFL_ENV);
    changed_ = true;
  }
  ~FloatEnvironment() {
    if (changed_) std::fesetenv(&callers_);
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
  static bool is_default();  // but for the flags of exceptions that were raised

  std::fenv_t callers_;
  bool changed_ = false;
};

}  // namespace powercell
