#include "lib/applications/transport/course.hpp"

#include <chrono>

namespace powercell {
namespace {

/// Whether masses are met as well as the integrals tell, which is not to the tolerance: steps go astray
/// there, and no end of them would count as converged.
bool drowned(const Course& course, const Iterate& at) {
  const double off = at.quadrature_error(course.target());
  return off >= course.tolerance() && at.error(course.target()) < off;
}

}  // namespace

Course::Course(Evaluator& evaluator, const TransportOptions& options, double tolerance, Vector target)
    : evaluator_(evaluator), options_(options), tolerance_(tolerance), target_(std::move(target)) {}

double Course::tolerance() const {
  return evaluator_.spread() > 0 ? blended_tolerance : tolerance_;
}

Direction Course::solve(const Laplacian& system, const Vector& right) {
  const auto start = std::chrono::steady_clock::now();
  Direction result;
  result.linear = solve_laplacian(system, right, options_.linear, options_.linear_residual,
                                  evaluator_.diagram().domain().cell_dimension());
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++solved_;
  return result;
}

void Course::accept(TransportStep step, const Iterate& at, const Vector& target) {
  step.step = static_cast<int>(steps_.size());
  step.error = at.error(target);
  step.gradient = at.gradient(target).norm();
  step.least = at.least(target);
  step.empty = at.empty;
  step.dual = at.dual(target);
  step.diagrams = static_cast<int>(evaluator_.count() - counted_);
  step.diagram_seconds = evaluator_.seconds() - timed_;
  counted_ = evaluator_.count();
  timed_ = evaluator_.seconds();
  step.spread = evaluator_.spread();
  steps_.push_back(step);
  if (options_.progress && !options_.progress(step)) throw Error(ErrorCode::interrupted, "interrupted");
  if (step.spread == 0) remember(at);
}

void Course::remember(const Iterate& at) {
  const double error = at.error(target_);
  if (best_.size() == 0 || at.empty < best_empty_ || (at.empty == best_empty_ && error < best_error_)) {
    best_ = at.weights;
    best_empty_ = at.empty;
    best_error_ = error;
  }
}

PhaseEnd solve_as_it_is(Course& course, Iterate& at) {
  const auto to_the_end = [&] {
    return newton(course, at, course.target(), course.tolerance(), TransportPhase::newton, 1);
  };
  PhaseEnd end = PhaseEnd::stalled;
  if (at.empty > 0) end = ascend(course, at, true);
  if (end != PhaseEnd::converged && at.empty == 0) end = to_the_end();
  if (at.empty == 0 && drowned(course, at)) return end;
  if (end == PhaseEnd::stalled && at.empty == 0) end = ramp(course, at);
  if (end == PhaseEnd::stalled || end == PhaseEnd::disconnected) end = ascend(course, at, false);
  return end;
}

Iterate run_course(Course& course, const Vector& weights) {
  Iterate at = find_start(course, weights);
  // A cell with next to nothing of its mass tells no more of where to go than an empty one.
  if (course.evaluator().uneven() && at.least(course.target()) < hopeless_share) blend(course, weights, at);
  const PhaseEnd end = solve_as_it_is(course, at);
  if (end == PhaseEnd::converged || at.weights == course.best()) return at;
  return course.evaluator().evaluate(course.best());
}

}  // namespace powercell
