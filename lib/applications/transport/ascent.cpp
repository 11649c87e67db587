#include <cmath>

#include "lib/applications/transport/phases.hpp"

namespace powercell {
namespace {

// Regularisation, in units of the typical derivatives. Above the largest the ascent has stalled.
constexpr double first_shift = 1, least_shift = 1e-9, most_shift = 1e6;
constexpr double shift_factor = 4;
constexpr double repaired = 0.01;  // min m_i / v_i from which damped Newton takes over

/// dm_i/dw_i of a cell of mass v_i in a regular grid of such cells, with the domain's mean density. Scales
/// the regularisation, as the derivative of an empty cell itself is 0.
Vector typical_derivative(const Vector& target, const Evaluator& evaluator) {
  const Domain& domain = evaluator.domain();
  const double d = domain.cell_dimension(), density = evaluator.all().sum_of(target) / domain.measure();
  // d density (v / density)^((d - 2)/d) in factors that do not overflow: masses may span hundreds of orders.
  return d * target.array().pow((d - 2) / d) * std::pow(density, 2 / d);
}

std::span<const double> span_of(const Vector& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

bool damped_newton_can_take_over(Evaluator& evaluator, const Iterate& at, const Vector& target) {
  return at.empty == 0 && at.least(target) >= repaired && evaluator.connects_all(at.laplacian());
}

PhaseEnd climb(SolveContext& context, Iterate& at, bool repair) {
  const Vector& target = context.target();
  Evaluator& evaluator = context.evaluator();
  const AllSeeds& all = evaluator.all();
  const Vector typical = typical_derivative(target, evaluator);
  double shift = first_shift;
  while (true) {
    if (context.reached(at)) return PhaseEnd::converged;
    if (repair && damped_newton_can_take_over(evaluator, at, target)) return PhaseEnd::stalled;
    const Vector gradient = at.gradient(target);
    const double value = at.dual(target);
    Direction direction;
    Iterate next;
    double rise = 0;
    while (true) {
      if (context.at_limit()) return PhaseEnd::step_limit;
      const Vector shifts = shift * typical;
      direction = context.solve(at.laplacian(span_of(shifts)), gradient);
      if (!direction.linear.broke_down &&
          evaluator.plausible(at.weights + direction.linear.solution, at.weights)) {
        next = evaluator.evaluate(at.weights + direction.linear.solution);
        // The dual is concave, so any sufficient rise is progress. A decrease of the gradient counts too:
        // near the maximum the rise is lost in rounding.
        rise = next.dual(target) - value;
        if (rise >= 1e-4 * all.dot(gradient, direction.linear.solution) ||
            next.gradient_norm(target) <= 0.75 * all.norm(gradient))
          break;
      }
      shift *= shift_factor;
      if (shift > most_shift) return PhaseEnd::stalled;
    }
    at = std::move(next);
    // Compares the rise with that of the quadratic model (Marquardt 1963).
    const Vector& taken = direction.linear.solution;
    const double predicted = (all.dot(gradient, taken) + shift * all.dot(taken.cwiseAbs2(), typical)) / 2;
    if (rise > 0.75 * predicted) shift = std::max(shift / shift_factor, least_shift);
    if (rise < 0.25 * predicted) shift *= shift_factor;
    context.record(step_along(direction, TransportPhase::ascent, 1), at, target);
  }
}

}  // namespace

PhaseEnd ascend(SolveContext& context, Iterate& at, bool repair) {
  Evaluator& evaluator = context.evaluator();
  evaluator.set_precise(true);
  if (evaluator.density_varies() && evaluator.spread() == 0) at = evaluator.evaluate(at.weights);
  const PhaseEnd end = climb(context, at, repair);
  evaluator.set_precise(false);
  return end;
}

}  // namespace powercell
