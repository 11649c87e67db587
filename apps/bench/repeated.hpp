/// \file
/// Repeated runs of a computation, and how many of them are enough.
#pragma once

#include <cstddef>
#include <powercell/powercell.hpp>
#include <vector>

namespace powercell::app {

/// Repeated runs of the same computation, from seeds in host memory to results in host memory.
struct TimedRuns {
  std::vector<double> seconds;  ///< of each run, kernels built before
  Timings phases;               ///< of the fastest

  double best() const;  ///< least seconds; 0 without a run
  /// By how much longer than the best run their lower quartile took, relative to the best: at least a quarter
  /// of the runs are that close to it. Of three runs it is the middle one that counts; of one the scatter is
  /// 0.
  double scatter() const;
  double spent() const;  ///< seconds of all runs
};

/// How often a computation is run.
struct RunLimits {
  std::size_t exactly = 0;  ///< so often; 0: until the scatter is small, or time is over
  double seconds = 1;       ///< time for all runs, if `exactly` is 0; three are made in any case
};

/// Scatter below which more runs would hardly change the best.
inline constexpr double settled_scatter = 0.05;

/// Whether these runs suffice: the figure has settled, which takes nine runs and a fifth of a second at
/// least, or the next run would take more than the time.
bool enough(const TimedRuns& runs, const RunLimits& limits);

}  // namespace powercell::app
