/// \file
/// Ctrl-C leaves no half-written file. A computation stops at its next progress report; anything else ends at
/// once, after unfinished files are removed.
#pragma once

namespace powercell::app {

/// Installs handlers for SIGINT, SIGTERM and SIGHUP.
void catch_interrupts();

/// Whether a signal has arrived.
bool interrupted() noexcept;

/// \throw Error interrupted if a signal has arrived
void stop_if_interrupted();

/// While an object of this class exists, the first signal only sets `interrupted()`; a second one ends the
/// process.
class Computing {
 public:
  Computing() noexcept;
  ~Computing();
  Computing(const Computing&) = delete;
  Computing& operator=(const Computing&) = delete;
};

/// Runs `work` as a computation.
/// \throw Error interrupted if a signal arrived meanwhile
template <class Work>
void compute(Work&& work) {
  {
    const Computing scope;
    work();
  }
  stop_if_interrupted();
}

}  // namespace powercell::app
