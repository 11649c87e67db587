#include <cmath>

#include "lib/applications/transport/course.hpp"

namespace powercell {
namespace {

constexpr double first_shift = 1, least_shift = 1e-9, most_shift = 1e6;
constexpr double repaired = 0.01;  // min m_i / v_i from which damped Newton goes on

/// dm_i/dw_i of a cell of mass v_i in a regular grid of such cells, with the domain's mean density: what an
/// empty cell, whose own derivative is 0, is counted with.
Vector typical_derivative(const Vector& target, const Domain& domain) {
  const double d = domain.cell_dimension(), density = target.sum() / domain.measure();
  // d density (v / density)^((d - 2)/d), with masses that may be hundreds of orders apart
  return d * target.array().pow((d - 2) / d) * std::pow(density, 2 / d);
}

std::span<const double> span_of(const Vector& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}

bool damped_newton_can_go_on(const Iterate& at, const Vector& target) {
  if (at.empty > 0 || at.least(target) < repaired) return false;
  return connected_components(
             make_laplacian(at.cells.walls.offset, at.cells.walls.neighbor, at.conductance, {}).matrix) == 1;
}

PhaseEnd climb(Course& course, Iterate& at, bool repair) {
  const Vector& target = course.target();
  const Vector typical = typical_derivative(target, course.evaluator().diagram().domain());
  double shift = first_shift;
  while (true) {
    if (course.reached(at)) return PhaseEnd::converged;
    if (repair && damped_newton_can_go_on(at, target)) return PhaseEnd::stalled;
    const Vector gradient = at.gradient(target);
    const double value = at.dual(target);
    Direction direction;
    Iterate next;
    double rise = 0;
    while (true) {
      if (course.at_limit()) return PhaseEnd::step_limit;
      const Vector shifts = shift * typical;
      direction = course.solve(
          make_laplacian(at.cells.walls.offset, at.cells.walls.neighbor, at.conductance, span_of(shifts)),
          gradient);
      if (!direction.linear.broke_down &&
          course.evaluator().possible(at.weights + direction.linear.solution, at.weights)) {
        next = course.evaluator().evaluate(at.weights + direction.linear.solution);
        // The dual is concave: any rise leads up. Where rises drown in rounding the gradient tells.
        rise = next.dual(target) - value;
        if (rise >= 1e-4 * gradient.dot(direction.linear.solution) ||
            next.gradient(target).norm() <= 0.75 * gradient.norm())
          break;
      }
      shift *= 4;
      if (shift > most_shift) return PhaseEnd::stalled;
    }
    at = std::move(next);
    // What the quadratic model with L promised, and what came (Marquardt 1963).
    const Vector& step_taken = direction.linear.solution;
    const double promised = (gradient.dot(step_taken) + shift * step_taken.cwiseAbs2().dot(typical)) / 2;
    if (rise > 0.75 * promised) shift = std::max(shift / 4, least_shift);
    if (rise < 0.25 * promised) shift *= 4;
    TransportStep step;
    step.phase = TransportPhase::ascent;
    step.length = 1;
    step.linear = direction.linear.solver;
    step.linear_iterations = direction.linear.iterations;
    step.linear_residual = direction.linear.residual;
    step.linear_seconds = direction.seconds;
    course.accept(step, at, target);
  }
}

}  // namespace

PhaseEnd ascend(Course& course, Iterate& at, bool repair) {
  Evaluator& evaluator = course.evaluator();
  evaluator.precise(true);
  if (evaluator.uneven() && evaluator.spread() == 0) at = evaluator.evaluate(at.weights);
  const PhaseEnd end = climb(course, at, repair);
  evaluator.precise(false);
  return end;
}

}  // namespace powercell
