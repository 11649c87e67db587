/// \file
/// Ctrl-C leaves no half-written file: a computation is asked to stop at its next progress report;
/// anything else ends at once, after unfinished files are removed.
#pragma once

namespace powercell::app {

/// Catches SIGINT, SIGTERM and SIGHUP from now on.
void catch_interrupts();

/// Whether one came.
bool interrupted() noexcept;

/// \throw Error interrupted if one came.
void stop_if_interrupted();

/// While one lives, a first Ctrl-C is left to `interrupted()`; a second one ends the process.
class Computing {
 public:
  Computing() noexcept;
  ~Computing();
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;
};

/// Runs `work` as a computation. \throw Error interrupted if Ctrl-C came meanwhile
template <class Work>
void compute(Work&& work) {
  {
    const Computing scope;
    work();
  }
  stop_if_interrupted();
}

}  // namespace powercell::app
