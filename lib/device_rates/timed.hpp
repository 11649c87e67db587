/// \file
/// Timings repeated until the least of them can be trusted.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace powercell {

/// The least of several timings, and by how much longer than it their lower quartile is, relative to it.
struct Timed {
  double least = 0, scatter = 0;
};

/// How often: `fewest` times, and on for `seconds`, but no more than `most` times.
struct Repeats {
  int fewest = 9, most = 100;
  double seconds = 0.3;
};

/// Calls `seconds_of_run` again and again. Times of 0, which a clock too coarse gives, do not count; if there
/// are no others, the result is 0.
template <class Run>
Timed timed(const Repeats& repeats, Run&& seconds_of_run) {
  std::vector<double> all;
  double spent = 0;
  for (int k = 0; k < repeats.fewest || (k < repeats.most && spent < repeats.seconds); ++k) {
    const double seconds = seconds_of_run();
    spent += seconds;
    if (seconds > 0) all.push_back(seconds);
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  const std::size_t quartile = std::min((all.size() + 3) / 4, all.size() - 1);
  return {all.front(), all[quartile] / all.front() - 1};
}

}  // namespace powercell
