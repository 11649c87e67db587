#include <algorithm>
#include <cmath>

#include "lib/applications/transport/diagram_evaluator.hpp"
#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

// The ratio of a blend is the mass of the density over that of the uniform density in it.
constexpr double first_ratio = 0.01, least_first_ratio = 1e-12;
// Factor from one ratio to the next, adapted to the number of diagrams that the last blend took.
constexpr double first_factor = 4, most_factor = 16, least_factor = 1.1;
constexpr std::size_t few_diagrams = 8, many_diagrams = 16;
constexpr double ready = 0.1;  // min m_i / v_i from which damped Newton takes over
// The uniform density is dropped when its mass is this share of the smallest target mass, or of all mass.
constexpr double of_smallest = 1e-3, least_part = 1e-30;

double uniform_share(double ratio) {
  return 1 / (1 + ratio);
}

/// Only densities that vary are blended, and these are not on ranks.
void set_spread(SolveContext& context, double share) {
  context.evaluator().in_one_place()->set_spread(share);
}

PhaseEnd newton_for_blend(SolveContext& context, Iterate& at) {
  return newton(context, at, {context.target(), context.tolerance()});
}

/// Looks for a blend that damped Newton solves from `at`, and solves it.
/// \return its ratio, 0 on failure
double blend_near(SolveContext& context, Iterate& at) {
  for (double ratio = 64; ratio > 1; ratio /= 4) {
    set_spread(context, uniform_share(ratio));
    Iterate trial = context.evaluator().evaluate(at.weights);
    if (trial.empty > 0 || trial.least(context.target()) < ready) continue;
    if (newton_for_blend(context, trial) != PhaseEnd::converged) return 0;
    at = std::move(trial);
    return ratio;
  }
  return 0;
}

/// Solves for the uniform density alone.
bool solve_uniform(SolveContext& context, const Vector& weights, Iterate& at) {
  set_spread(context, 1);
  at = find_start(context, weights);
  return solve_current_density(context, at) == PhaseEnd::converged;
}

/// Evaluates the solution of a blend for the plain density, and accepts it if damped Newton can take over.
bool drop_uniform(SolveContext& context, const Vector& weights, double ratio, Iterate& at) {
  const Vector& target = context.target();
  set_spread(context, 0);
  Iterate plain = context.evaluator().evaluate(weights);
  context.keep_best(plain);
  const bool good = plain.empty == 0 && plain.least(target) >= ready;
  if (good || uniform_share(ratio) < std::max(least_part, of_smallest * target.minCoeff() / target.sum())) {
    at = std::move(plain);
    return true;
  }
  return false;
}

/// Solves the next blend.
/// \param blended  solution of the last blend, then of the next
/// \param ratio    of the blend; 0 for the uniform density alone
/// \param factor   to the next ratio, adapted
bool next_blend(SolveContext& context, Iterate& blended, double& ratio, double& factor) {
  Evaluator& evaluator = context.evaluator();
  double next = ratio > 0 ? ratio * factor : first_ratio;
  while (true) {
    const std::size_t before = evaluator.diagrams();
    set_spread(context, uniform_share(next));
    Iterate trial = evaluator.evaluate(blended.weights);
    const PhaseEnd end = newton_for_blend(context, trial);
    if (end == PhaseEnd::step_limit) return false;
    if (end == PhaseEnd::converged) {
      blended = std::move(trial);
      ratio = next;
      const std::size_t taken = evaluator.diagrams() - before;
      if (taken <= few_diagrams) factor = std::min(std::pow(factor, 1.5), most_factor);
      if (taken > many_diagrams) factor = std::max(std::sqrt(factor), least_factor);
      return true;
    }
    if (ratio == 0) {
      next /= most_factor;
      if (next < least_first_ratio) return false;
    } else {
      factor = std::sqrt(factor);
      next = ratio * factor;
      if (factor < least_factor) return false;
    }
  }
}

/// Solves blends of increasing ratio until the uniform density can be dropped.
bool follow_blends(SolveContext& context, Iterate& blended, double ratio, Iterate& at) {
  double factor = first_factor;
  while (ratio == 0 || !drop_uniform(context, blended.weights, ratio, at))
    if (!next_blend(context, blended, ratio, factor)) return false;
  return true;
}

}  // namespace

bool blend(SolveContext& context, const Vector& weights, Iterate& at) {
  Iterate blended = at;
  const double near = blend_near(context, blended);
  const bool done =
      (near > 0 || solve_uniform(context, weights, blended)) && follow_blends(context, blended, near, at);
  set_spread(context, 0);
  return done;
}

}  // namespace powercell
