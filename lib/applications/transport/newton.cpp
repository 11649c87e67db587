#include <algorithm>

#include "lib/applications/linear/damping.hpp"
#include "lib/applications/transport/course.hpp"

namespace powercell {
namespace {

constexpr double shortest = 1.0 / 4096;  // step that is tried
constexpr double short_step = 1.0 / 32;  // at most
constexpr int most_short_steps = 8;      // in a row

}  // namespace

PhaseEnd newton(Course& course, Iterate& at, const Vector& target, double tolerance, TransportPhase phase,
                double exponent) {
  const double least = kept_share(at.least(target));
  // A blend that takes short steps is too far from the one before: one between them comes first.
  const double spread = course.evaluator().spread();
  const int patience = spread > 0 && spread < 1 ? 1 : most_short_steps;
  int short_steps = 0;
  double longest = 1;
  while (true) {
    if (at.error(target) < tolerance || course.reached(at)) return PhaseEnd::converged;
    if (course.at_limit()) return PhaseEnd::step_limit;
    const Laplacian system =
        make_laplacian(at.cells.walls.offset, at.cells.walls.neighbor, at.conductance, {});
    if (connected_components(system.matrix) > 1) return PhaseEnd::disconnected;
    const Vector gradient = at.gradient(target);
    const Direction direction = course.solve(system, gradient);
    if (direction.linear.broke_down) return PhaseEnd::stalled;
    Iterate next;
    const double length = damped_length(
        shortest,
        [&](double trial) {
          Vector weights = at.weights + trial * direction.linear.solution;
          if (!course.evaluator().possible(weights, at.weights)) return false;
          next = course.evaluator().evaluate(std::move(weights));
          return next.empty == 0 && next.least(target) >= least &&
                 decreases_enough(next.gradient(target).norm(), gradient.norm(), trial);
        },
        longest);
    if (length == 0) return PhaseEnd::stalled;
    at = std::move(next);
    TransportStep step;
    step.phase = phase;
    step.exponent = exponent;
    step.length = length;
    step.linear = direction.linear.solver;
    step.linear_iterations = direction.linear.iterations;
    step.linear_residual = direction.linear.residual;
    step.linear_seconds = direction.seconds;
    course.accept(step, at, target);
    longest = std::min(1.0, 4 * length);
    short_steps = length <= short_step ? short_steps + 1 : 0;
    if (short_steps == patience) return PhaseEnd::stalled;
  }
}

}  // namespace powercell
