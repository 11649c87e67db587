#include <algorithm>
#include <cmath>

#include "lib/applications/transport/course.hpp"

namespace powercell {
namespace {

// Of the density's mass over that of the constant.
constexpr double first_ratio = 0.01, least_first_ratio = 1e-12;
constexpr double first_factor = 4, most_factor = 16, least_factor = 1.1;
constexpr std::size_t few_diagrams = 8, many_diagrams = 16;  // for a step of the ratio
constexpr double ready = 0.1;                                // min m_i / v_i from where damped Newton goes on
// Shares of the constant below which nothing is changed any more: of the smallest mass, and at all.
constexpr double of_smallest = 1e-3, least_share = 1e-30;

double share_of_constant(double ratio) {
  return 1 / (1 + ratio);
}

PhaseEnd newton_for_blend(Course& course, Iterate& at) {
  return newton(course, at, course.target(), course.tolerance(), TransportPhase::newton, 1);
}

/// A blend that damped Newton solves from `at`, and its ratio. \return none if there is none
double blend_near(Course& course, Iterate& at) {
  for (double ratio = 64; ratio > 1; ratio /= 4) {
    course.evaluator().spread(share_of_constant(ratio));
    Iterate trial = course.evaluator().evaluate(at.weights);
    if (trial.empty > 0 || trial.least(course.target()) < ready) continue;
    if (newton_for_blend(course, trial) != PhaseEnd::converged) return 0;
    at = std::move(trial);
    return ratio;
  }
  return 0;
}

/// The constant alone. \return whether it was solved
bool solve_constant(Course& course, const Vector& weights, Iterate& at) {
  course.evaluator().spread(1);
  at = find_start(course, weights);
  return solve_as_it_is(course, at) == PhaseEnd::converged;
}

/// From weights of a blend to those of the density as it is, if damped Newton can go on there.
bool drop_constant(Course& course, const Vector& weights, double ratio, Iterate& at) {
  const Vector& target = course.target();
  course.evaluator().spread(0);
  Iterate plain = course.evaluator().evaluate(weights);
  course.remember(plain);
  const bool good = plain.empty == 0 && plain.least(target) >= ready;
  if (good ||
      share_of_constant(ratio) < std::max(least_share, of_smallest * target.minCoeff() / target.sum())) {
    at = std::move(plain);
    return true;
  }
  return false;
}

/// Solves the next blend. \param ratio  of the one that is solved, 0 for the constant alone
/// \param factor  to the next ratio, as far as it proves possible
bool next_blend(Course& course, Iterate& blended, double& ratio, double& factor) {
  Evaluator& evaluator = course.evaluator();
  double next = ratio > 0 ? ratio * factor : first_ratio;
  while (true) {
    const std::size_t before = evaluator.count();
    evaluator.spread(share_of_constant(next));
    Iterate trial = evaluator.evaluate(blended.weights);
    const PhaseEnd end = newton_for_blend(course, trial);
    if (end == PhaseEnd::step_limit) return false;
    if (end == PhaseEnd::converged) {
      blended = std::move(trial);
      ratio = next;
      const std::size_t taken = evaluator.count() - before;
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

bool drop_slowly(Course& course, Iterate& blended, double ratio, Iterate& at) {
  double factor = first_factor;
  while (ratio == 0 || !drop_constant(course, blended.weights, ratio, at))
    if (!next_blend(course, blended, ratio, factor)) return false;
  return true;
}

}  // namespace

bool blend(Course& course, const Vector& weights, Iterate& at) {
  Iterate blended = at;
  const double near = blend_near(course, blended);
  const bool done =
      (near > 0 || solve_constant(course, weights, blended)) && drop_slowly(course, blended, near, at);
  course.evaluator().spread(0);
  return done;
}

}  // namespace powercell
