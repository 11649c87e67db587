#include "bench/paper/trial.hpp"

#include <chrono>
#include <ctime>
#include <powercell/error.hpp>

namespace powercell::paper {

namespace {

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Way tree_way() {
  Options options;
  options.neighbors = Neighbors::tree;
  return {"tree", options};
}

Way list_way(int initial) {
  Options options;
  options.neighbors = Neighbors::flann;
  options.initial_neighbors = initial;
  return {"flann", options};
}

Trial::Trial(const Device& device, const Domain& domain, std::vector<Way> ways) : ways_(std::move(ways)) {
  for (const Way& way : ways_) diagrams_.emplace_back(device, domain, way.options);
}

Time Trial::run_once(std::size_t way, const SeedsView& seeds) {
  Diagram& diagram = diagrams_[way];
  // What is kept of these seeds from an earlier run must not help.
  diagram.set_seeds({seeds.dimension, seeds.positions.first(static_cast<std::size_t>(seeds.dimension)), {}});
  diagram.measures();
  const double processor = processor_seconds(), wall = wall_seconds();
  diagram.set_seeds(seeds);
  const Measures& measures = diagram.measures();
  const Time time{processor_seconds() - processor, wall_seconds() - wall, diagram.timings()};
  const double tolerance = diagram.precision() == Precision::float64 ? 1e-11 : 1e-4;
  if (!(measures.relative_error() <= tolerance))
    throw Error(ErrorCode::internal, ways_[way].name + ": the measures sum to " +
                                         std::to_string(measures.total()) + ", not " +
                                         std::to_string(measures.domain_measure));
  return time;
}

std::vector<Time> Trial::run(const SeedsView& seeds, int repeats) {
  std::vector<Time> best(ways_.size());
  if (!warm_)
    for (std::size_t w = 0; w < ways_.size(); ++w) run_once(w, seeds);
  warm_ = true;
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t w = 0; w < ways_.size(); ++w) {
      const Time time = run_once(w, seeds);
      if (repeat == 0 || time.processor < best[w].processor) best[w] = time;
    }
  return best;
}

}  // namespace powercell::paper
