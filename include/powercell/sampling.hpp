/// \file
/// Blue-noise sampling: points whose power cells all have the same mass of a density.
#pragma once

#include <cstdint>
#include <functional>
#include <powercell/density.hpp>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/point_sets.hpp>
#include <span>
#include <vector>

namespace powercell {

/// Purpose of the points. Minimising the energy to convergence makes them crystallise, which blue noise must
/// not.
enum class SamplingMode {
  blue,      ///< even but irregular: stops at a hexatic order in the plane, elsewhere after 20 iterations
  quantise,  ///< lowest energy: the best quantiser of the density
};

/// How the points move.
enum class SamplingDescent {
  automatic,  ///< lloyd for blue, lbfgs for quantise
  lloyd,  ///< to the centroids of their cells: few moves make the points even, thousands bring them to rest
  lbfgs,  ///< limited-memory BFGS with 7 pairs and the initial inverse Hessian 1 / (2 m_i)
};

/// State after one iteration, which moves all points. M is the mass of the domain.
struct SamplingStep {
  int iteration = 0;  ///< 0 for the initial points
  /// E = max over the weights of the dual, the sum of the second moments. The value here is below that
  /// maximum by the order of capacity_error².
  double energy = 0;
  double gradient = 0;        ///< root mean square of |c_i - p_i|, a length
  double hexatic = 0;         ///< Spacing::hexatic; NaN if not needed
  double capacity_error = 0;  ///< max |m_i / (M/n) - 1|
  int newton_steps = 0;       ///< of the transport
  double seconds = 0;         ///< wall-clock time of this iteration, without compiling kernels
};

struct SamplingOptions {
  Density density = Density::constant(1);
  SamplingMode mode = SamplingMode::blue;
  SamplingDescent descent = SamplingDescent::automatic;
  /// The domain is a box with its opposite sides identified: short for Domain::periodic_box. In a periodic
  /// domain the density must be constant.
  bool periodic = false;
  /// Limit on iterations. 0 means 100 for blue in the plane, 20 for blue elsewhere, 10,000 for quantise.
  int iterations = 0;
  /// Blue in the plane stops at this hexatic order, after at least one iteration. With fewer than 50 points,
  /// or fewer than five neighbours per point on average (as in a row of points), the order is not meaningful
  /// and it stops after 20 iterations. It also stops where the order no longer grows, by less than 0.01 in 10
  /// iterations after the 20th. Between 0 and 1.
  double hexatic = 0.61;
  /// Quantise, and blue in the plane, stop when the gradient is below this fraction of the spacing
  /// (measure of the domain / n)^(1/d'), d' the dimension of the cells, or when rounding allows no further
  /// descent. With 0, quantise stops after `iterations`.
  double movement = 1e-4;
  /// Limit on max |m_i / (M/n) - 1| in the result. Between 0 and 1.
  double capacity_tolerance = 1e-6;
  std::uint64_t random_seed = 1;  ///< of the initial points
  Options diagram;
  /// Called after each iteration; returning false stops with Error interrupted.
  std::function<bool(const SamplingStep&)> progress;
};

/// Parts of cells that are not connected with the part that has the point: those on the other side of a thin
/// plate, or across a narrow gap. There the points are fewer than their share.
struct PartsApart {
  std::size_t cells = 0;  ///< cells with such parts
  double share = 0;       ///< of the domain's area or volume in such parts
  /// Distance of such a part's centroid from the part with the point, the median by area or volume: about the
  /// thickness of the plate or the width of the gap. 0 if there are no such parts.
  double distance = 0;
};

/// The points, in the order of the initial points. Arrays are owned.
struct SamplingResult {
  /// Both errors are below capacity_tolerance, and the mode's criterion is met: the hexatic order or movement
  /// is reached, or no longer grows, or all iterations are done where they are the criterion (blue with the
  /// default number; blue outside the plane; movement 0).
  bool converged = false;
  std::vector<double> positions;  ///< n x d, row-major, in the domain (on a surface: on it)
  std::vector<double> weights;    ///< n, length²: with them all cells have equal mass
  std::vector<double> mass;       ///< n: masses of the cells
  double capacity_error = 0;      ///< max |m_i / (M/n) - 1|
  double quadrature_error = 0;    ///< of these masses, relative to M/n: see TransportResult
  double energy = 0;              ///< sum of the cells' second moments about their points
  /// Energy relative to the best lattice with cells of the same measure: hexagonal (5 / (18 sqrt 3)) on
  /// polygons and surfaces, body-centred cubic in volumes. Its minimum tends to 1 for many points.
  double relative_energy = 0;
  PartsApart apart;  ///< of the cells; nothing is apart in a periodic box
  /// The numbers of points on the layers of a surface that were sampled apart (see sample()), else empty. The
  /// energies and gradients of `steps` are then those on the layers.
  std::vector<std::size_t> layers;
  Spacing layer_spacing;  ///< of each point among those of its layer; zeros without layers
  std::vector<SamplingStep> steps;
};

/// Capacity-constrained sampling (Balzer et al. 2009; by power diagrams: de Goes et al. 2012, Xiao et al.
/// 2023). Each iteration finds the weights that give every cell the same mass (TransportSolver), then moves
/// the points ((35)-(37) of docs/mathematics.md).
///
/// Blue noise on a surface whose sides are nearer to each other than 0.7 of the spacing, (measure / n)^(1/2),
/// on more than 1 % of its mass: the surface is cut into layers without such sides, and the points move as if
/// the layers were far from each other, so that each has its share of the points. The weights, masses and
/// energy are those of cells on the surface as it is, which reach through to other layers (`apart`).
/// \param n  number of points; they start at random with the density (random_points)
/// \throw Error invalid_argument (no points; an option out of range), unsupported (a periodic domain that is
///   not a box, or a density that is not constant there), interrupted; as TransportSolver and
///   random_points
POWERCELL_API SamplingResult sample(const Device& device, const Domain& domain, std::size_t n,
                                    const SamplingOptions& options = {});

/// The same, from given initial points, without layers.
/// \param positions  n x d, row-major; they may lie outside the domain, but no two at the same position
POWERCELL_API SamplingResult sample(const Device& device, const Domain& domain,
                                    std::span<const double> positions, const SamplingOptions& options = {});

}  // namespace powercell
