#include "apps/tune/choice.hpp"

#include <algorithm>
#include <cmath>

namespace powercell::app {
namespace {

/// Of the best times: below 1 if `trial` is faster.
double ratio(const TimedRuns& trial, const TimedRuns& first) {
  return trial.best() / first.best();
}

bool is_better(const Trial& trial, const Trial& first) {
  bool better = false;
  for (std::size_t job = 0; job < first.runs.size(); ++job) {
    const double change = ratio(trial.runs[job], first.runs[job]) - 1,
                 nothing = spread(trial.runs[job], first.runs[job]);
    if (change > nothing) return false;
    better = better || change < -nothing;
  }
  return better;
}

double mean_ratio(const Trial& trial, const Trial& first) {
  double sum = 0;
  for (std::size_t job = 0; job < first.runs.size(); ++job)
    sum += std::log(ratio(trial.runs[job], first.runs[job]));
  return std::exp(sum / static_cast<double>(first.runs.size()));
}

}  // namespace

double spread(const TimedRuns& a, const TimedRuns& b) {
  return std::max(least_gain, a.scatter() + b.scatter());
}

std::size_t best_trial(const std::vector<Trial>& trials) {
  std::size_t best = 0;
  double least = 1;
  for (std::size_t k = 1; k < trials.size(); ++k) {
    if (!trials[k].failure.empty() || !is_better(trials[k], trials[0])) continue;
    const double mean = mean_ratio(trials[k], trials[0]);
    if (mean >= least) continue;
    best = k;
    least = mean;
  }
  return best;
}

}  // namespace powercell::app
