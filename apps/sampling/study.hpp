/// \file
/// Several samplings and their figures.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <powercell/powercell.hpp>
#include <vector>

#include "apps/sampling/source.hpp"

namespace powercell::app {

class Progress;
inline constexpr const char* sampling_stage = "sampling";

struct Run {
  SamplingResult points;
  Spacing spacing;               ///< on layers if there are any; NaN where no point has a neighbour
  double seconds = 0;            ///< wall clock, without compiling kernels, as the next
  double processor_seconds = 0;  ///< of all threads
};

struct Study {
  std::vector<Run> runs;
  std::optional<Spectrum> spectrum;  ///< mean of the runs; only for periodic boxes and on request
};

/// \param runs  their number; random seeds count up from options.random_seed
/// \param progress  in `sampling_stage`
/// \param spectra  whether to compute them, which takes n² time
Study run_study(const Device& device, const Source& source, std::size_t n, const SamplingOptions& options,
                int runs, bool spectra, Progress& progress);

/// Keys: runs (a list), mean, spectrum (radial frequencies in waves per box; power; anisotropy in decibels;
/// low_frequency up to half of sqrt(n); low_frequencies up to several fractions of sqrt(n)).
/// \param with_power  also the whole spectrum, row by row
nlohmann::json as_json(const Study& study, bool with_power);

/// "1,024 points, 22 iterations, ..."
std::string line_of(const Run& run);
/// The mean of the runs.
std::string summary_of(const Study& study);

}  // namespace powercell::app
