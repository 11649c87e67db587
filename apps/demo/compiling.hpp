/// \file
/// What the demo says while kernels are compiled.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>

namespace powercell::app {

class Progress;

/// While it lives, the bar says how many programs are being compiled, of about how many; without a terminal a
/// line says once that it happens. It follows the library's log, unless POWERCELL_LOG asks for that.
class Compiling {
 public:
  /// \param programs  of a run with nothing in any cache
  Compiling(Progress& progress, std::string device, std::size_t programs, bool silent);
  ~Compiling();
  Compiling(const Compiling&) = delete;
  Compiling& operator=(const Compiling&) = delete;

  std::size_t programs() const { return built_; }

 private:
  void say();

  Progress& progress_;
  std::string device_;
  std::size_t all_;
  bool silent_, said_ = false, follows_;
  std::atomic<std::size_t> built_{0};
};

}  // namespace powercell::app
