/// \file
/// The phases of a solve, and the state that they share.
#pragma once

#include <algorithm>

#include "lib/applications/transport/evaluator.hpp"

namespace powercell {

/// min m_i / v_i below which a better start is looked for.
inline constexpr double poor_share = 0.01;
/// min m_i / v_i below which the density is blended with a uniform one.
inline constexpr double blended_share = 1e-4;

/// min m_i / v_i below which a cell of a domain of several parts counts as empty for connect().
inline constexpr double starved_share = 1e-3;

/// The mass of a seed in a part of the domain.
struct PartShare {
  std::uint32_t part, seed;
  double mass;
};

/// How a phase ended.
enum class PhaseEnd {
  converged,
  stalled,       ///< no step is accepted, or only short ones
  disconnected,  ///< no walls connect some groups of cells: the linear system has no unique solution
  step_limit,
};

/// What damped Newton solves for. Refers to the target.
struct Aim {
  const Vector& target;
  double tolerance;
  TransportPhase phase = TransportPhase::newton;
  double exponent = 1;
  bool at_least = false;  ///< no cell may lack more than the tolerance, but any may have more than its mass
};

/// The solution of the linear system of one step.
struct Direction {
  LinearResult linear;
  double seconds = 0;  ///< wall-clock time
};

/// The state of one solve: steps so far, limits, and the best weights. Phases pass the current iterate along.
class SolveContext {
 public:
  /// Evaluator and options are kept by reference.
  /// \param tolerance_given  false if it is the default
  /// \param target  of the seeds here
  SolveContext(Evaluator& evaluator, const TransportOptions& options, double tolerance, bool tolerance_given,
               Vector target);

  Evaluator& evaluator() { return evaluator_; }
  const Vector& target() const { return target_; }
  /// The tolerance of the masses; a loose one while the density is blended.
  double tolerance() const;
  /// Whether the domain has several connected parts.
  bool has_several_parts() const { return several_parts_; }
  /// The masses of the seeds in the parts by (31d); empty without such a start.
  const std::vector<PartShare>& shares() const { return shares_; }
  void set_shares(std::vector<PartShare> shares) { shares_ = std::move(shares); }
  bool at_limit() const { return solved_ >= options_.max_steps; }
  /// The tolerance, or if the caller gave none and it is larger, the error to which rounded weights can meet
  /// masses.
  double attainable(const Iterate& at, const Vector& target, double tolerance) const {
    constexpr double most = 1e-3;  // masses farther off are not those that were asked for
    return tolerance_given_ ? tolerance : std::max(tolerance, std::min(at.rounding_error(target), most));
  }
  /// Whether the target masses are met to the tolerance, or as well as the rounding of weights allows. Walls
  /// may be missing then.
  bool reached(const Iterate& at) const {
    return at.empty == 0 && at.error(target_) < attainable(at, target_, tolerance());
  }
  const std::vector<TransportStep>& steps() const { return steps_; }
  int steps_left() const { return options_.max_steps - solved_; }
  /// Counts the steps of another solve against the limit.
  void count_steps(const SolveContext& of) { solved_ += of.solved_; }

  /// Solves system x = right.
  Direction solve(const Laplacian& system, const Vector& right);
  /// Records an accepted step: fills in what follows from the iterate, calls the progress callback, and
  /// updates the best weights.
  /// \param step    with phase, exponent, length and linear solve
  /// \param target  of the phase
  void record(TransportStep step, const Iterate& at, const Vector& target);
  /// Updates the best weights.
  /// \param at  evaluated for the density without a blend
  void keep_best(const Iterate& at);

  /// The best weights so far: those with the fewest empty cells, then the least error.
  const Vector& best() const { return best_; }

 private:
  Evaluator& evaluator_;
  const TransportOptions& options_;
  double tolerance_;
  bool tolerance_given_;
  Vector target_;
  bool several_parts_;
  std::vector<PartShare> shares_;
  std::vector<TransportStep> steps_;
  int solved_ = 0;
  std::size_t recorded_diagrams_ = 0;  // diagrams of the steps so far
  double recorded_seconds_ = 0;        // and their time
  bool has_best_ = false;
  Vector best_;
  std::size_t best_empty_ = 0;
  double best_error_ = 0;
};

/// A step of `length` along a direction, for SolveContext::record.
TransportStep step_along(const Direction& direction, TransportPhase phase, double length);

/// Chooses an iterate to start from: the given weights if no cell is empty; else fractions of them; else 0;
/// else weights as if all seeds were moved into the domain by one affine map, (31a). Of all tried the one
/// with the fewest empty cells. If a cell is far below its mass, also weights as if the seeds were moved onto
/// the density, (31b), or by levels of clusters, if these are better.
Iterate find_start(SolveContext& context, const Vector& weights);
/// Tries weights as if all seeds were moved into the domain's box by one affine map, (31a).
void try_into_box(Evaluator& evaluator, const Vector& target, Iterate& best);
/// Where a cell is empty or far below its mass: tries weights by levels of clusters of seeds, small beside
/// the distances between them. The parts of each cluster are spread over its cell by a transport with an
/// entropy. Takes these weights if they are better.
void try_by_levels(SolveContext& context, Iterate& best);
/// For a domain of several parts and a constant density: tries weights (31d), which share the seeds among the
/// parts, unless hardly any mass is misplaced. Replaces `best` if the dual is larger for them.
void try_on_parts(SolveContext& context, Iterate& best);
/// Raises the weights of groups of cells that lack mass, where walls connect no cell of the group to others,
/// and of cells with less than the share `starved` of their mass, until these take what they need from
/// others, or half of a cell: Newton's method can then pass mass to them.
/// \return false if there is one group, or none could be raised
bool raise_starved(SolveContext& context, Iterate& at, const Vector& target, double starved);
/// raise_starved() as a step of its own, for cells with hardly any mass.
bool connect(SolveContext& context, Iterate& at, const Vector& target);
/// Damped Newton, (27)-(29).
PhaseEnd newton(SolveContext& context, Iterate& at, const Aim& aim);
/// The same; on domains of several parts in turn with connect().
PhaseEnd newton_across_gaps(SolveContext& context, Iterate& at, const Aim& aim);
/// newton_across_gaps for masses between the present ones and a target, (31h), until each cell has the share
/// `least` of its mass.
/// \param at  without empty cells
/// \return converged, stalled or step_limit
PhaseEnd approach(SolveContext& context, Iterate& at, const Vector& target, double least);
/// newton_across_gaps for increasing powers of the masses.
PhaseEnd ramp(SolveContext& context, Iterate& at);
/// Regularised Newton on the dual, (30).
/// \param repair  ends as soon as damped Newton can take over
PhaseEnd ascend(SolveContext& context, Iterate& at, bool repair);
/// The three phases above as needed, for the evaluator's current blend of the density.
PhaseEnd solve_current_density(SolveContext& context, Iterate& at);
/// Continuation for densities with almost no mass in some cells: solves for blends with a uniform density,
/// (31c), of decreasing share.
/// \param weights  the given ones, from which the uniform density is solved
/// \param at       the start; on success an iterate from which damped Newton can take over
/// \return false on failure, with `at` unchanged
bool blend(SolveContext& context, const Vector& weights, Iterate& at);
/// All phases as needed. Whether it converged shows in the error of the returned iterate.
Iterate run_phases(SolveContext& context, const Vector& weights);

}  // namespace powercell
