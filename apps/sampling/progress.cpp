#include "apps/sampling/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace powercell::app {

std::function<bool(const SamplingStep&)> sampling_progress(Progress& progress, const SamplingOptions& options,
                                                           const Domain& domain, std::size_t points) {
  const bool blue = options.mode == SamplingMode::blue;
  const double at_rest = options.movement * std::pow(domain.measure() / static_cast<double>(points),
                                                     1.0 / domain.cell_dimension());
  const int iterations = options.iterations > 0            ? options.iterations
                         : blue && domain.dimension() == 3 ? 20
                                                           : 0;
  return [&progress, blue, at_rest, iterations, goal = options.hexatic, first = SamplingStep{},
          approach = Approach()](const SamplingStep& step) mutable {
    if (step.iteration == 0) first = step;
    std::string note = fmt::format("step {}", step.iteration);
    double share = iterations > 0 ? static_cast<double>(step.iteration) / iterations : 0;
    if (blue && std::isfinite(step.hexatic)) {
      note += fmt::format(", hexatic {:.2f}", step.hexatic);
      if (first.hexatic < goal)
        share = std::max(share, (step.hexatic - first.hexatic) / (goal - first.hexatic));
    } else if (at_rest > 0 && first.gradient > at_rest) {
      share = std::max(share, logarithmic_share(step.gradient, first.gradient, at_rest));
    }
    progress.note(std::move(note));
    return progress.at(approach.step(share));
  };
}

}  // namespace powercell::app
