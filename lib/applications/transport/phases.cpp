#include "lib/applications/transport/phases.hpp"

#include <chrono>

#include "lib/applications/transport/domain_parts.hpp"

namespace powercell {
namespace {

constexpr int most_connections = 60;
constexpr double fair_share = 1.0 / 30;  // min m_i / v_i from which Newton's method leads to the masses
constexpr double uneven_masses = 30;     // ratio of the largest to the least from which a ramp comes first

bool are_uneven(SolveContext& context) {
  const AllSeeds& all = context.evaluator().all();
  return all.greatest_of(context.target()) > uneven_masses * all.least_of(context.target());
}

/// Equal masses where the target's differ by orders: those take fewer steps from far away.
Vector even_masses(SolveContext& context) {
  const Evaluator& evaluator = context.evaluator();
  if (!are_uneven(context)) return context.target();
  const double total = evaluator.all().sum_of(context.target());
  return Vector::Constant(context.target().size(), total / static_cast<double>(evaluator.count()));
}

/// Whether the masses are met within their quadrature error, which exceeds the tolerance: further steps
/// follow noise, and none would count as converged.
bool limited_by_quadrature(const SolveContext& context, const Iterate& at) {
  const double quadrature_error = at.quadrature_error(context.target());
  return quadrature_error >= context.tolerance() && at.error(context.target()) < quadrature_error;
}

/// Whether the masses are met within the rounding of the weights: further steps follow noise.
bool limited_by_rounding(SolveContext& context, const Iterate& at) {
  return context.evaluator().spread() == 0 &&
         at.error(context.target()) < at.rounding_error(context.target());
}

}  // namespace

SolveContext::SolveContext(Evaluator& evaluator, const TransportOptions& options, double tolerance,
                           bool tolerance_given, Vector target)
    : evaluator_(evaluator),
      options_(options),
      tolerance_(tolerance),
      tolerance_given_(tolerance_given),
      target_(std::move(target)),
      several_parts_(domain_parts(evaluator.domain()).count > 1) {}

double SolveContext::tolerance() const {
  return evaluator_.spread() > 0 ? blend_tolerance : tolerance_;
}

Direction SolveContext::solve(const Laplacian& system, const Vector& right) {
  const auto start = std::chrono::steady_clock::now();
  Direction result;
  result.linear = evaluator_.solve(system, right);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ++solved_;
  return result;
}

void SolveContext::record(TransportStep step, const Iterate& at, const Vector& target) {
  step.step = static_cast<int>(steps_.size());
  step.error = at.error(target);
  step.gradient = at.gradient_norm(target);
  step.least = at.least(target);
  step.empty = at.empty;
  step.dual = at.dual(target);
  step.diagrams = static_cast<int>(evaluator_.diagrams() - recorded_diagrams_);
  step.diagram_seconds = evaluator_.seconds() - recorded_seconds_;
  recorded_diagrams_ = evaluator_.diagrams();
  recorded_seconds_ = evaluator_.seconds();
  step.spread = evaluator_.spread();
  steps_.push_back(step);
  if (options_.progress && !options_.progress(step)) throw Error(ErrorCode::interrupted, "interrupted");
  if (step.spread == 0) keep_best(at);
}

void SolveContext::keep_best(const Iterate& at) {
  const double error = at.error(target_);
  if (!has_best_ || at.empty < best_empty_ || (at.empty == best_empty_ && error < best_error_)) {
    has_best_ = true;
    best_ = at.weights;
    best_empty_ = at.empty;
    best_error_ = error;
  }
}

TransportStep step_along(const Direction& direction, TransportPhase phase, double length) {
  TransportStep step;
  step.phase = phase;
  step.length = length;
  step.linear = direction.linear.solver;
  step.linear_iterations = direction.linear.iterations;
  step.linear_residual = direction.linear.residual;
  step.linear_seconds = direction.seconds;
  return step;
}

PhaseEnd newton_across_gaps(SolveContext& context, Iterate& at, const Aim& aim) {
  const Vector& target = aim.target;
  const auto solve = [&] { return newton(context, at, aim); };
  if (!context.has_several_parts()) return solve();
  for (int k = 0; k < most_connections; ++k) {
    if (at.least(target) >= starved_share) {
      const PhaseEnd end = solve();
      if (end != PhaseEnd::disconnected) return end;
    }
    if (!connect(context, at, target)) break;
  }
  return at.empty == 0 ? solve() : PhaseEnd::disconnected;
}

PhaseEnd solve_current_density(SolveContext& context, Iterate& at) {
  PhaseEnd end = PhaseEnd::stalled;
  const auto newton_to_target = [&] {
    if (at.empty == 0 && at.least(context.target()) < hopeless_share &&
        approach(context, at, even_masses(context), fair_share) == PhaseEnd::step_limit)
      return PhaseEnd::step_limit;
    return newton_across_gaps(context, at, {context.target(), context.tolerance()});
  };
  if (context.has_several_parts()) {
    if (context.shares().empty() || !are_uneven(context)) end = newton_to_target();
    if (end == PhaseEnd::stalled && !context.shares().empty()) end = ramp(context, at);
    if (end == PhaseEnd::converged) return end;
  }
  if (at.empty > 0) end = ascend(context, at, true);
  if (end != PhaseEnd::converged && at.empty == 0) end = newton_to_target();
  if (at.empty == 0 && (limited_by_quadrature(context, at) || limited_by_rounding(context, at))) return end;
  if (end == PhaseEnd::stalled && at.empty == 0) end = ramp(context, at);
  if (end == PhaseEnd::stalled || end == PhaseEnd::disconnected) end = ascend(context, at, false);
  return end;
}

Iterate run_phases(SolveContext& context, const Vector& weights) {
  Iterate at = find_start(context, weights);
  // A cell with almost none of its mass gives no more guidance than an empty one.
  if (context.evaluator().density_varies() && at.least(context.target()) < blended_share)
    blend(context, weights, at);
  const PhaseEnd end = solve_current_density(context, at);
  if (end == PhaseEnd::converged || !at.all->any(at.weights != context.best())) return at;
  return context.evaluator().evaluate(context.best());
}

}  // namespace powercell
