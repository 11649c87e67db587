/// \file
/// Semi-discrete optimal transport: finds weights such that the cells of given seeds have given masses.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <powercell/density.hpp>
#include <powercell/diagram.hpp>
#include <powercell/linear_solver.hpp>
#include <span>
#include <vector>

namespace powercell {

/// Phase of the solver that made a step.
enum class TransportPhase {
  start,   ///< choice of the initial weights; no linear system was solved
  newton,  ///< damped Newton towards the prescribed masses
  ramp,    ///< damped Newton towards intermediate masses
  ascent,  ///< regularised Newton on the dual, which tolerates empty cells
};

/// Stable lower-case name, e.g. "newton".
POWERCELL_API const char* name(TransportPhase phase) noexcept;

/// One accepted step. m are the masses after the step, v the target masses of its phase.
struct TransportStep {
  int step = 0;  ///< from 0, counted through all phases
  TransportPhase phase = TransportPhase::start;
  /// ramp: v is proportional to this power of the masses, or this share of the way from those at the start,
  /// as logarithms.
  double exponent = 1;
  double spread = 0;      ///< share of the domain's mass replaced by a uniform density; 0 at the end
  double error = 0;       ///< max |m_i / v_i - 1|
  double gradient = 0;    ///< |v - m|, Euclidean
  double least = 0;       ///< min m_i / v_i
  std::size_t empty = 0;  ///< number of cells without mass
  double dual = 0;        ///< dual value for v (see TransportResult)
  double length = 0;      ///< step length, 1 for a full step
  int diagrams = 0;       ///< diagrams computed for the step: 1 if its first length was accepted
  LinearSolver linear = LinearSolver::automatic;  ///< solver used; automatic if nothing was solved
  int linear_iterations = 0;                      ///< 0 for a direct solver
  double linear_residual = 0;                     ///< |b - L x| / |b|
  double diagram_seconds = 0;                     ///< wall-clock time of all its diagrams
  double linear_seconds = 0;                      ///< wall-clock time of its linear system
};

struct TransportOptions {
  /// Mass per unit of area or volume.
  Density density = Density::constant(1);
  /// The domain is a box with its opposite sides identified: short for Domain::periodic_box. In a periodic
  /// domain the density must be constant. Seeds outside stand for their images inside; the centroids are near
  /// the seeds as given.
  bool periodic = false;
  /// Converged when max |m_i / v_i - 1| and the quadrature errors relative to v_i are below this value, in
  /// [0, 1). 0 means 1e-6, in single precision 1e-3.
  double tolerance = 0;
  /// Limit on the steps of all phases together.
  int max_steps = 500;
  LinearSolver linear = LinearSolver::automatic;
  /// Relative residual of an iterative linear solve, in (0, 1). Looser ones stall when masses differ widely.
  double linear_residual = 1e-4;
  /// Scale the masses so that their sum is the domain's mass. If false, their sum must match it to within a
  /// relative 1e-9.
  bool rescale = false;
  /// Options of the diagrams: precision, neighbours, threads. Its `progress` is called within each diagram.
  Options diagram;
  /// Called after each step; returning false stops with Error interrupted.
  std::function<bool(const TransportStep&)> progress;
};

/// Result of a solve. Arrays are owned and in the order of the seeds.
struct POWERCELL_API TransportResult {
  /// error < tolerance (if that is the default: or < rounding_error, up to 10⁻³) and quadrature_error <
  /// tolerance. If false, the result is the best iterate: one with the fewest empty cells, and of these the
  /// one with the least error.
  bool converged = false;
  double error = 0;  ///< max |m_i / v_i - 1|
  /// The largest estimated quadrature error of m_i, relative to v_i: above 0 where a formula or function has
  /// jumps or kinks. The true masses match v to within `error` plus this.
  double quadrature_error = 0;
  /// A bound for the error of m_i, relative to v_i, that comes of weights being doubles: above the tolerance
  /// where parts of the domain, or seeds, are some 10⁴ cells or more apart. Masses cannot be met better.
  double rounding_error = 0;
  double tolerance = 0;  ///< as used
  /// n, length²: with mean 0 over the seeds that are not merged.
  std::vector<double> weights;
  std::vector<double> target;         ///< n: v, the prescribed masses, rescaled if requested
  std::vector<double> mass;           ///< n: masses of the cells; 0 for merged seeds
  std::vector<double> centroid;       ///< n x d, row-major; NaN for empty cells and merged seeds
  std::vector<double> second_moment;  ///< n: integral of |x - p_i|² over the cell
  /// n: the seed with the lowest index at the same position; the seed itself unless merged. Seeds at one
  /// position share a cell, whose mass is the sum of theirs.
  std::vector<std::uint32_t> merged_with;
  std::size_t merged = 0;  ///< number of seeds merged with another
  double total_mass = 0;   ///< of the domain
  /// Sum of the second moments: the cost of moving the cells' masses to their seeds. W2² when converged.
  double primal = 0;
  /// Φ = sum of second_moment_i - w_i m_i + v_i w_i: a lower bound of W2² at any weights.
  double dual = 0;
  std::vector<TransportStep> steps;
  std::size_t diagrams = 0;  ///< number of diagrams computed

  /// Number of steps that solved a linear system.
  std::size_t newton_steps() const;
};

/// Finds the weights for seeds and masses, repeatedly as these change. Not thread-safe; different solvers may
/// run in different threads, also on the same device. If a call throws, the earlier settings remain.
///
/// Damped Newton on the concave dual (Kitagawa, Mérigot, Thibert 2019; (25)-(31c) of docs/mathematics.md),
/// warm-started from the weights of the last solve, adjusted to seeds that moved. Fallbacks cover initially
/// empty cells, seeds outside the domain, masses over many orders of magnitude, densities with peaks and
/// seeds at the same position.
class POWERCELL_API TransportSolver {
 public:
  /// \throw Error invalid_argument (an option out of range), no_fp64, unsupported (periodic, and the domain
  ///   is not a box or the density not constant)
  TransportSolver(Device device, Domain domain, TransportOptions options = {});
  TransportSolver(TransportSolver&&) noexcept;
  TransportSolver& operator=(TransportSolver&&) noexcept;
  ~TransportSolver();

  /// Sets new seeds, copied. The next solve starts from their weights, or from 0 without weights. The masses
  /// are kept if the number of seeds is the same, else reset to equal ones.
  /// \throw Error invalid_argument (sizes; no seeds), invalid_seed
  void set_seeds(const SeedsView& seeds);
  /// Moves the seeds. The next solve starts from w_i - |p'_i - p_i|², which is within about one Newton step
  /// of the solution when seeds move to their centroids.
  /// \param positions  n x d, row-major
  /// \throw Error invalid_argument (size; no seeds yet), invalid_seed
  void move_seeds(std::span<const double> positions);
  /// Sets the n weights from which the next solve starts.
  /// \throw Error invalid_argument (size), invalid_seed (not finite)
  void set_weights(std::span<const double> weights);
  /// Sets the n target masses, in the unit of the domain's mass, all positive. Empty means equal masses.
  /// \throw Error invalid_argument (size; negative, zero or not finite: which seed)
  void set_masses(std::span<const double> masses);

  /// Changes the tolerance, e.g. for a rough solve within a loop. 0 means that of the options.
  /// \throw Error invalid_argument unless in [0, 1)
  void set_tolerance(double tolerance);

  /// Changes the limit on linear solves of TransportOptions, e.g. within a loop.
  /// \throw Error invalid_argument if negative
  void set_max_steps(int steps);

  /// Solves from the current weights. Failure to converge is not an error: see TransportResult::converged.
  /// \return valid until the next solve
  /// \throw Error invalid_argument (no seeds; sum of the masses), interrupted; as Diagram
  const TransportResult& solve();
  /// Result of the last solve.
  const TransportResult& result() const;

  /// The diagram of all seeds with the weights of the last solve.
  /// \throw Error invalid_argument (before the first solve, or if seeds were set or moved since)
  Diagram& diagram();

  struct State;  ///< library-internal

 private:
  std::unique_ptr<State> state_;
};

/// Solves once, from the weights of the seeds, or from 0 without weights.
/// \param masses  n, or empty for equal masses
/// \throw as TransportSolver
POWERCELL_API TransportResult transport(const Device& device, const Domain& domain, const SeedsView& seeds,
                                        std::span<const double> masses = {},
                                        const TransportOptions& options = {});

}  // namespace powercell
