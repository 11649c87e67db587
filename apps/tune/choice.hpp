/// \file
/// Which of several settings of a device is faster, if the runs can tell.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/bench/record.hpp"

namespace powercell::app {

/// A value of a setting, timed on some jobs.
struct Trial {
  std::uint64_t value = 0;
  std::vector<TimedRuns> runs;  ///< of each job
  std::string failure;          ///< why it cannot be used, else empty
};

/// Less than this is not worth a file, however little the runs scatter.
inline constexpr double least_gain = 0.03;

/// Relative differences up to this say nothing: the scatter of both.
double spread(const TimedRuns& a, const TimedRuns& b);

/// The trial to take instead of the first one, or 0 to keep that: the fastest in the geometric mean over the
/// jobs, of those that are faster than the first by more than the spread in some job and slower by more in
/// none.
std::size_t best_trial(const std::vector<Trial>& trials);

}  // namespace powercell::app
