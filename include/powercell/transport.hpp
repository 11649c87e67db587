/// \file
/// Semi-discrete optimal transport: the weights with which the cells of given seeds have given masses.
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

/// What a step of the solver was.
enum class TransportPhase {
  start,   ///< a diagram of weights to start from; nothing was solved
  newton,  ///< damped Newton towards the masses
  ramp,    ///< damped Newton towards a power below 1 of the masses
  ascent,  ///< regularised Newton on the dual, which may pass through empty cells
};

/// Stable lower-case name, e.g. "newton".
POWERCELL_API const char* name(TransportPhase phase) noexcept;

/// One accepted step. m are the masses after it, v the masses asked for in its phase.
struct TransportStep {
  int step = 0;  ///< from 0, counted through all phases
  TransportPhase phase = TransportPhase::start;
  double exponent = 1;    ///< ramp: v is proportional to this power of the masses
  double spread = 0;      ///< share of the domain's mass that is spread evenly over it; 0 at the end
  double error = 0;       ///< max |m_i / v_i - 1|
  double gradient = 0;    ///< |v - m|, Euclidean
  double least = 0;       ///< min m_i / v_i
  std::size_t empty = 0;  ///< cells without mass
  double dual = 0;        ///< the dual value for v (see TransportResult)
  double length = 0;      ///< of the step, 1 for a full one
  int diagrams = 0;       ///< computed for the step: 1 if its first length was accepted
  LinearSolver linear = LinearSolver::automatic;  ///< what was used; automatic where nothing was solved
  int linear_iterations = 0;                      ///< 0 where it was direct
  double linear_residual = 0;                     ///< |b - L x| / |b|
  double diagram_seconds = 0;                     ///< wall clock, of all its diagrams
  double linear_seconds = 0;                      ///< wall clock, of its linear system
};

struct TransportOptions {
  /// Mass for each unit of area or volume.
  Density density = Density::constant(1);
  /// The domain is a box of the plane with its opposite sides identified; the density must be constant. Seeds
  /// outside stand for their copies inside, and centroids are near the seeds as given.
  bool periodic = false;
  /// Converged when max |m_i / v_i - 1|, and the errors of these integrals, are below. 0 means 1e-6, in
  /// single precision 1e-3.
  double tolerance = 0;
  /// Steps of all phases together.
  int max_steps = 500;
  LinearSolver linear = LinearSolver::automatic;
  /// Of an iterative linear solve, relative. Looser stalls where masses differ widely.
  double linear_residual = 1e-4;
  /// Masses are multiplied by the domain's mass by their sum. Else a sum that differs by more than 1e-9 of
  /// it is refused.
  bool rescale = false;
  /// Of the diagrams: precision, neighbours, threads. `progress` is called within each diagram.
  Options diagram;
  /// Called after each step; returning false stops with Error interrupted.
  std::function<bool(const TransportStep&)> progress;
};

/// What a solve came to. Arrays are in the order of the seeds given.
struct POWERCELL_API TransportResult {
  /// error < tolerance and quadrature_error < tolerance. If not, what follows is the best iterate: no empty
  /// cell if there was one without, and of those the one of least error.
  bool converged = false;
  double error = 0;  ///< max |m_i / v_i - 1|
  /// The largest estimate of what the integral m_i is off by, over v_i: above 0 where a formula or function
  /// has jumps or kinks. The masses are met to `error` and this together.
  double quadrature_error = 0;
  double tolerance = 0;  ///< as used
  /// n, length²: of mean 0 over the seeds that are not merged.
  std::vector<double> weights;
  std::vector<double> target;         ///< n: v, as asked for and rescaled
  std::vector<double> mass;           ///< n: of the cells; 0 for merged seeds
  std::vector<double> centroid;       ///< n x d, row-major; NaN for empty cells and merged seeds
  std::vector<double> second_moment;  ///< n: integral of |x - p_i|² over the cell
  /// n: the seed that this one is merged with, of the lowest index at its position; itself for most. One cell
  /// serves them all, with the sum of their masses.
  std::vector<std::uint32_t> merged_with;
  std::size_t merged = 0;  ///< seeds merged with another
  double total_mass = 0;   ///< of the domain
  /// Sum of the second moments: the cost of moving the cells' masses to their seeds. W2² when converged.
  double primal = 0;
  /// Φ = sum of second_moment_i - w_i m_i + v_i w_i: a lower bound of W2² at any weights.
  double dual = 0;
  std::vector<TransportStep> steps;
  std::size_t diagrams = 0;  ///< computed in all

  /// Steps that solved a linear system.
  std::size_t newton_steps() const;
};

/// Finds weights for seeds and masses, again and again as they change. Not thread-safe; different solvers may
/// run in different threads, also on one device. If a call throws, what was set before stays.
///
/// Damped Newton on the concave dual (Kitagawa, Mérigot, Thibert 2019; mathematics, (25)-(31c)). It starts
/// from the weights of the last solve, moved with the seeds. What stops others is dealt with: cells that are
/// empty at the start, seeds outside the domain, masses over many orders of magnitude, densities with peaks,
/// seeds at one position.
class POWERCELL_API TransportSolver {
 public:
  /// \throw Error invalid_argument (an option out of its range), no_fp64, unsupported (periodic, and no box
  /// of the plane or a density that is not constant)
  TransportSolver(Device device, Domain domain, TransportOptions options = {});
  TransportSolver(TransportSolver&&) noexcept;
  TransportSolver& operator=(TransportSolver&&) noexcept;
  ~TransportSolver();

  /// New seeds; their weights, if there are any, are where the next solve starts. Masses are kept if the
  /// number of seeds is the same, else they are equal from here on. \throw Error invalid_argument (sizes, no
  /// seed), invalid_seed
  void set_seeds(const SeedsView& seeds);
  /// The same seeds at new positions. The next solve starts from w_i - |p'_i - p_i|², which is within about
  /// one Newton step when seeds move to their centroids. \throw Error invalid_argument (size, no seeds yet),
  /// invalid_seed
  void move_seeds(std::span<const double> positions);
  /// Where the next solve starts. \throw Error invalid_argument (size), invalid_seed (not finite)
  void set_weights(std::span<const double> weights);
  /// n masses in the unit of the domain's, all positive; empty means equal ones.
  /// \throw Error invalid_argument (size; negative, zero or not finite: which seed)
  void set_masses(std::span<const double> masses);

  /// Changes tolerances between solves, as for a rough solve in a loop. 0 as in the options.
  void set_tolerance(double tolerance);

  /// Solves from where the weights are. Not to converge is no error: see TransportResult::converged.
  /// \throw Error invalid_argument (no seeds; sum of the masses), interrupted, and what Diagram throws
  const TransportResult& solve();
  /// Of the last solve.
  const TransportResult& result() const;

  /// The diagram of all seeds with the weights of the last solve. \throw Error invalid_argument before it,
  /// also where seeds were set or moved since; unsupported for a periodic box
  Diagram& diagram();

  struct State;  ///< library-internal

 private:
  std::unique_ptr<State> state_;
};

/// One-off solve from weights 0, or from the weights of the seeds if they have any.
/// \param masses  n, or empty for equal ones   \throw as TransportSolver
POWERCELL_API TransportResult transport(const Device& device, const Domain& domain, const SeedsView& seeds,
                                        std::span<const double> masses = {},
                                        const TransportOptions& options = {});

}  // namespace powercell
