#include <algorithm>

#include "lib/applications/linear/damping.hpp"
#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

constexpr double shortest = 1.0 / 4096;   // shortest step tried
constexpr double short_step = 1.0 / 32;   // a step up to this length counts as short
constexpr int most_short_steps = 8;       // in a row, before another phase is more promising
constexpr std::size_t most_starved = 20;  // one in so many: a shorter step is cheaper where more are starved
constexpr int most_rounds = 4;            // of starved cells after one step; each takes a diagram
constexpr int few_short_steps = 2;        // the same where ramp() has good intermediate targets

/// Whether small masses become better although the rounding of large ones hides that in the gradient.
bool better_but_for_rounding(const Iterate& at, const Iterate& next, const Vector& target) {
  return next.error(target) <= at.error(target) / 2 &&
         next.gradient_norm(target) <= at.gradient_norm(target) + next.all->norm(next.rounding());
}

/// Gives mass back to cells that a step has left with less than the share `least`. Where masses differ by
/// orders, small cells vanish in steps that are good for all others.
/// \return whether no cell has less
bool feed(SolveContext& context, Iterate& next, const Vector& target, double least) {
  constexpr std::size_t few = 3;
  if (next.empty > std::max(few, context.evaluator().count() / most_starved)) return false;
  for (int k = 0; k < most_rounds; ++k) {
    const std::size_t before = next.empty;
    if (!raise_starved(context, next, target, least)) return false;
    if (next.empty == 0 && next.least(target) >= least) return true;
    if (next.empty > before / 2) return false;
  }
  return false;
}

}  // namespace

PhaseEnd newton(SolveContext& context, Iterate& at, const Aim& aim) {
  const Vector& target = aim.target;
  const double least = kept_share(at.least(target));
  // A blend that takes a short step is too far from the one before; the caller tries one between them.
  const double spread = context.evaluator().spread();
  const bool blended = spread > 0 && spread < 1, can_ramp = aim.exponent == 1 && !context.shares().empty();
  const int patience = blended ? 1 : can_ramp ? few_short_steps : most_short_steps;
  constexpr double growth = 2;  // where masses are uneven, many steps in a row have a fourth of the length
  int short_steps = 0;
  double longest = 1;
  while (true) {
    if (aim.at_least
            ? at.least(target) >= 1 - aim.tolerance
            : at.error(target) < context.attainable(at, target, aim.tolerance) || context.reached(at))
      return PhaseEnd::converged;
    if (context.at_limit()) return PhaseEnd::step_limit;
    const Laplacian system = at.laplacian();
    if (!context.evaluator().connects_all(system)) return PhaseEnd::disconnected;
    const double off = at.gradient_norm(target);
    const Direction direction = context.solve(system, at.gradient(target));
    if (direction.linear.broke_down) return PhaseEnd::stalled;
    Iterate next;
    const double length = damped_length(
        shortest,
        [&](double trial) {
          Vector weights = at.weights + trial * direction.linear.solution;
          if (!context.evaluator().plausible(weights, at.weights)) return false;
          next = context.evaluator().evaluate(std::move(weights));
          const auto better = [&] {
            return decreases_enough(next.gradient_norm(target), off, trial) ||
                   better_but_for_rounding(at, next, target);
          };
          if (!better()) return false;
          if (next.empty == 0 && next.least(target) >= least) return true;
          return context.has_several_parts() && feed(context, next, target, least) && better();
        },
        longest);
    if (length == 0) return PhaseEnd::stalled;
    at = std::move(next);
    TransportStep step = step_along(direction, aim.phase, length);
    step.exponent = aim.exponent;
    context.record(step, at, target);
    longest = std::min(1.0, growth * length);
    short_steps = length <= short_step ? short_steps + 1 : 0;
    if (short_steps == patience) return PhaseEnd::stalled;
  }
}

}  // namespace powercell
