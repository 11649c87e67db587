/// \file
/// Timing of diagrams on the same seeds, in turn. Uses the public interface only.
#pragma once

#include <powercell/diagram.hpp>
#include <string>
#include <vector>

namespace powercell::paper {

/// A way to compute the same cells.
struct Way {
  std::string name;
  Options options;
};
Way tree_way();
/// The paper's lists. \param initial 0: as the library chooses
Way list_way(int initial = 0);

struct Time {
  double processor = 0;  ///< seconds of processor time of all threads, seeds to measures
  double wall = 0;       ///< seconds
  Timings timings;       ///< the library's own, of the same run
};

/// Diagrams that are computed again and again: one a way.
class Trial {
 public:
  Trial(const Device& device, const Domain& domain, std::vector<Way> ways);

  /// Computes the measures `repeats` times each way, one way after the other so that what else the machine
  /// does meets all of them, and each without what it may have kept of these seeds; gives each way's run of
  /// least processor time. Before the first timed run of a trial each way has run once, which builds its
  /// kernels and grows its buffers. \throw Error internal if the measures do not sum to the domain's
  std::vector<Time> run(const SeedsView& seeds, int repeats);
  /// How many of the seeds of the last run are hidden.
  std::size_t hidden() { return diagrams_.front().measures().count(SeedStatus::hidden); }
  /// How far the measures of the last run sum from the domain's.
  double relative_error(std::size_t way) { return diagrams_[way].measures().relative_error(); }
  const std::vector<Way>& ways() const { return ways_; }

 private:
  Time run_once(std::size_t way, const SeedsView& seeds);

  std::vector<Way> ways_;
  std::vector<Diagram> diagrams_;
  bool warm_ = false;
};

}  // namespace powercell::paper
