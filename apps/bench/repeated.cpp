#include "apps/bench/repeated.hpp"

#include <algorithm>
#include <numeric>

namespace powercell::app {
namespace {

constexpr std::size_t fewest_runs = 3, settled_runs = 9;
// Whatever disturbs runs lasts longer than the shortest of them: all nine might be disturbed alike.
constexpr double settled_seconds = 0.2;

}  // namespace

double TimedRuns::best() const {
  return seconds.empty() ? 0 : *std::min_element(seconds.begin(), seconds.end());
}

double TimedRuns::scatter() const {
  if (seconds.size() < 2) return 0;
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  return sorted[std::min((sorted.size() + 3) / 4, sorted.size() - 1)] / sorted.front() - 1;
}

double TimedRuns::spent() const {
  return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

bool enough(const TimedRuns& runs, const RunLimits& limits) {
  const std::size_t count = runs.seconds.size();
  if (limits.exactly > 0) return count >= limits.exactly;
  if (count < fewest_runs) return false;
  const double spent = runs.spent();
  if (spent + runs.best() > limits.seconds) return true;
  return count >= settled_runs && spent >= settled_seconds && runs.scatter() <= settled_scatter;
}

}  // namespace powercell::app
