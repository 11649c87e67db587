#include <algorithm>

#include "lib/applications/linear/damping.hpp"
#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

constexpr double shortest = 1.0 / 4096;  // shortest step tried
constexpr double short_step = 1.0 / 32;  // a step up to this length counts as short
constexpr int most_short_steps = 8;      // in a row, before another phase is more promising
constexpr int few_short_steps = 2;       // the same where ramp() has good intermediate targets

}  // namespace

PhaseEnd newton(SolveContext& context, Iterate& at, const Vector& target, double tolerance,
                TransportPhase phase, double exponent) {
  const double least = kept_share(at.least(target));
  // A blend that takes a short step is too far from the one before; the caller tries one between them.
  const double spread = context.evaluator().spread();
  const bool blended = spread > 0 && spread < 1, can_ramp = exponent == 1 && !context.shares().empty();
  const int patience = blended ? 1 : can_ramp ? few_short_steps : most_short_steps;
  int short_steps = 0;
  double longest = 1;
  while (true) {
    if (at.error(target) < context.attainable(at, target, tolerance) || context.reached(at))
      return PhaseEnd::converged;
    if (context.at_limit()) return PhaseEnd::step_limit;
    const Laplacian system = at.laplacian();
    if (connected_components(system.matrix) > 1) return PhaseEnd::disconnected;
    const Vector gradient = at.gradient(target);
    const Direction direction = context.solve(system, gradient);
    if (direction.linear.broke_down) return PhaseEnd::stalled;
    Iterate next;
    const double length = damped_length(
        shortest,
        [&](double trial) {
          Vector weights = at.weights + trial * direction.linear.solution;
          if (!context.evaluator().plausible(weights, at.weights)) return false;
          next = context.evaluator().evaluate(std::move(weights));
          return next.empty == 0 && next.least(target) >= least &&
                 decreases_enough(next.gradient(target).norm(), gradient.norm(), trial);
        },
        longest);
    if (length == 0) return PhaseEnd::stalled;
    at = std::move(next);
    TransportStep step = step_along(direction, phase, length);
    step.exponent = exponent;
    context.record(step, at, target);
    longest = std::min(1.0, 4 * length);
    short_steps = length <= short_step ? short_steps + 1 : 0;
    if (short_steps == patience) return PhaseEnd::stalled;
  }
}

}  // namespace powercell
