/// \file
/// How far a sampling is.
#pragma once

#include <functional>
#include <powercell/powercell.hpp>

#include "apps/progress.hpp"

namespace powercell::app {

/// SamplingOptions::progress that reports to the current part of a stage; for the time of that object. The
/// fraction follows the goal of the options: the hexatic order, the movement, or the number of iterations.
std::function<bool(const SamplingStep&)> sampling_progress(Progress& progress, const SamplingOptions& options,
                                                           const Domain& domain, std::size_t points);

}  // namespace powercell::app
