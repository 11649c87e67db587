/// \file
/// One solve: what its phases share. Internal.
#pragma once

#include "lib/applications/transport/iterate.hpp"

namespace powercell {

/// min m_i / v_i below which another start is looked for.
inline constexpr double poor_share = 0.01;
/// And below which the density is blended with a constant.
inline constexpr double hopeless_share = 1e-4;

/// How a phase ended.
enum class PhaseEnd {
  converged,
  stalled,       ///< no step is accepted, or only ever shorter ones
  disconnected,  ///< cells fall into parts without walls between them: the system has no one solution
  step_limit,
};

/// The linear system of one step: solution and what it took.
struct Direction {
  LinearResult linear;
  double seconds = 0;
};

/// The solve so far. Phases take the iterate they work on from one to the next.
class Course {
 public:
  Course(Evaluator& evaluator, const TransportOptions& options, double tolerance, Vector target);

  Evaluator& evaluator() { return evaluator_; }
  const Vector& target() const { return target_; }
  /// A rough one while the density is blended.
  double tolerance() const;
  bool at_limit() const { return solved_ >= options_.max_steps; }
  /// The masses are those asked for: nothing is left to do, and walls may be missing.
  bool reached(const Iterate& at) const { return at.empty == 0 && at.error(target_) < tolerance(); }
  const std::vector<TransportStep>& steps() const { return steps_; }

  /// Solves (L + shift) x = right. An empty shift asks for a connected system.
  Direction solve(const Laplacian& system, const Vector& right);
  /// Logs an accepted step: fills in what follows from the iterate, and remembers it.
  /// \param target  of the phase
  void accept(TransportStep step, const Iterate& at, const Vector& target);
  /// Keeps the weights if they are the best so far. \param at  of the density as it is
  void remember(const Iterate& at);

  /// The best weights so far: fewest empty cells, then least error.
  const Vector& best() const { return best_; }

 private:
  Evaluator& evaluator_;
  const TransportOptions& options_;
  double tolerance_;
  Vector target_;
  std::vector<TransportStep> steps_;
  int solved_ = 0;
  std::size_t counted_ = 0;  // diagrams in the steps so far
  double timed_ = 0;         // seconds in those
  Vector best_;
  std::size_t best_empty_ = 0;
  double best_error_ = 0;
};

/// An iterate to start from: the weights given if no cell is empty, else fractions of them, else 0, else
/// seeds moved into the domain as one; of all tried the one with the fewest empty cells. Where a cell has
/// nearly nothing of its mass, seeds moved onto the density as one if that is better.
Iterate find_start(Course& course, const Vector& weights);
/// Damped Newton for a target of its own; (27)-(29).
PhaseEnd newton(Course& course, Iterate& at, const Vector& target, double tolerance, TransportPhase phase,
                double exponent);
/// Newton for growing powers of the masses.
PhaseEnd ramp(Course& course, Iterate& at);
/// Regularised Newton on the dual, (30). \param repair  ends as soon as damped Newton can go on
PhaseEnd ascend(Course& course, Iterate& at, bool repair);
/// Those three as needed, for the density as the evaluator has it.
PhaseEnd solve_as_it_is(Course& course, Iterate& at);
/// Where nearly nothing of the density lies in some cells: solves for blends of it with a constant, (31c),
/// with ever less of the latter. \param weights  as given, from where the constant alone is solved
/// \param at  the start, then where damped Newton can go on \return false, with `at` as it was, if that fails
bool blend(Course& course, const Vector& weights, Iterate& at);
/// All of them, as needed. Returns an iterate; converged or not shows in its error.
Iterate run_course(Course& course, const Vector& weights);

}  // namespace powercell
