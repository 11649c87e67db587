/// \file
/// Blue noise: points whose power cells all hold the same mass of a density.
#pragma once

#include <cstdint>
#include <functional>
#include <powercell/density.hpp>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <span>
#include <vector>

namespace powercell {

/// What points are for. Minimising the energy to the end makes crystals, so there are two answers.
enum class SamplingMode {
  blue,  ///< evenly spaced and irregular: in the plane stopped at a hexatic order, else after 20 iterations
  quantise,  ///< of least energy: the best points to stand for the density
};

/// How points move.
enum class SamplingDescent {
  lloyd,  ///< to the centroids of their cells
  lbfgs,  ///< limited-memory BFGS, 7 pairs, started from 1 / (2 m_i)
};

/// One move of all points.
struct SamplingStep {
  int iteration = 0;  ///< from 0, the points at the start
  /// E = max over weights of the dual: sum of the second moments. Short of it by the order of
  /// capacity_error².
  double energy = 0;
  double gradient = 0;        ///< root mean square of |c_i - p_i|, length
  double hexatic = 0;         ///< Spacing::hexatic; NaN where it was not needed
  double capacity_error = 0;  ///< max |m_i / (M/n) - 1|
  int newton_steps = 0;       ///< of the transport
  double seconds = 0;         ///< wall clock, of this iteration
};

struct SamplingOptions {
  Density density = Density::constant(1);
  SamplingMode mode = SamplingMode::blue;
  SamplingDescent descent = SamplingDescent::lloyd;
  /// The domain is a box of the plane with its opposite sides identified; the density must be constant.
  bool periodic = false;
  /// Moves at most. 0: 100 for blue in the plane, 20 for blue elsewhere, 1000 for quantise.
  int iterations = 0;
  /// Blue in the plane ends at this hexatic order, after a move at least; of less than 50 points, or where
  /// they have less than five neighbours on average, as in a row, the order says nothing, and it ends after
  /// 20 moves.
  double hexatic = 0.61;
  /// Quantise, and blue in the plane, end when the gradient is below this fraction of the spacing
  /// (M's measure / n)^(1/d'); with 0 quantise ends after `iterations` moves, or where rounding allows none.
  double movement = 1e-4;
  /// max |m_i / (M/n) - 1| at the end.
  double capacity_tolerance = 1e-6;
  std::uint64_t random_seed = 1;  ///< of the points to start from
  Options diagram;
  /// Called after each iteration; returning false stops with Error interrupted.
  std::function<bool(const SamplingStep&)> progress;
};

/// Points in the order of those at the start.
struct SamplingResult {
  /// Both errors below the tolerance of the capacities, and by mode: hexatic order or movement reached, or
  /// all iterations done where that was asked (elsewhere than in the plane; movement 0).
  bool converged = false;
  std::vector<double> positions;  ///< n x d, row-major, in the domain (on a surface: on it)
  std::vector<double> weights;    ///< n, length^2: of the cells of equal mass
  std::vector<double> mass;       ///< n
  double capacity_error = 0;      ///< max |m_i / (M/n) - 1|
  double quadrature_error = 0;    ///< of these masses, over M/n: see TransportResult
  double energy = 0;              ///< of the positions and weights
  /// Energy over that of the best lattice with cells of the same measures: hexagonal (5 / (18 sqrt 3)) on
  /// polygons and surfaces, body-centred cubic in volumes. 1 is the least possible for many points.
  double relative_energy = 0;
  std::vector<SamplingStep> steps;
};

/// Capacity-constrained sampling (Balzer et al. 2009; by power diagrams de Goes et al. 2012; Xiao et al.
/// 2023): each iteration finds the weights that give every cell the same mass (TransportSolver) and moves the
/// points (mathematics, (35)-(37)). \param n  points, started at random in the density \throw Error
/// invalid_argument (no points, an option out of its range), unsupported (a periodic domain that is
///   no box of the plane, or has another density), interrupted, and what TransportSolver throws
POWERCELL_API SamplingResult sample(const Device& device, const Domain& domain, std::size_t n,
                                    const SamplingOptions& options = {});

/// The same from points of the caller's, no two at one place. \param positions  n x d, row-major
POWERCELL_API SamplingResult sample(const Device& device, const Domain& domain,
                                    std::span<const double> positions, const SamplingOptions& options = {});

}  // namespace powercell
