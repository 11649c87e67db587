/// \file
/// Evaluation of weights: the masses of their cells and the derivatives. Internal.
#pragma once

#include <optional>
#include <powercell/transport.hpp>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

/// Relative error to which the masses of blended densities are solved: enough to start the next blend from.
inline constexpr double blend_tolerance = 0.1;

/// Weights with everything that is evaluated at them. v are target masses.
struct Iterate {
  Vector weights;  ///< with mean 0
  DensityIntegrals cells;
  /// Parallel to cells.walls: c_ij = -dm_i/dw_j, (15). Empty if the masses are met and walls would cost
  /// extra.
  std::vector<double> conductance;
  std::size_t empty = 0;  ///< number of cells without mass

  Eigen::Map<const Vector> mass() const {
    return {cells.mass.data(), static_cast<Eigen::Index>(cells.mass.size())};
  }
  /// max |m_i / v_i - 1|
  double error(const Vector& target) const;
  /// The largest quadrature error of a mass relative to v_i.
  double quadrature_error(const Vector& target) const;
  /// Bounds for the errors of the masses from the rounding of the weights, (31f); 0 without conductances.
  Vector rounding() const;
  /// The largest of these relative to v_i.
  double rounding_error(const Vector& target) const {
    return (rounding().array() / target.array()).maxCoeff();
  }
  /// min m_i / v_i
  double least(const Vector& target) const;
  /// v - m, the gradient of the dual
  Vector gradient(const Vector& target) const { return target - mass(); }
  /// The matrix of (27), plus a diagonal `shift` unless that is empty.
  Laplacian laplacian(std::span<const double> shift = {}) const;
  /// Sum of the second moments.
  double primal() const;
  /// (26)
  double dual(const Vector& target) const;
};

/// The masses to solve for and their tolerance. Refers to the target.
struct Goal {
  const Vector& target;
  double tolerance;
};

/// Evaluates weights of the seeds of a diagram.
class Evaluator {
 public:
  /// The first three arguments are kept by reference.
  /// \param positions  n x d, those of the diagram
  /// \param threads    for the integrals; 0 means all
  Evaluator(Diagram& diagram, const Density& density, std::span<const double> positions, const Goal& goal,
            int threads);
  /// Subtracts the mean from the weights and evaluates them. They remain set in the diagram.
  Iterate evaluate(Vector weights);

  /// Sets the share of the domain's mass that is replaced by a uniform density, (31c). The density must not
  /// be constant.
  void set_spread(double share);
  double spread() const { return spread_; }
  /// Whether integrals must be accurate enough for the result whatever the error of the masses. For phases
  /// that compare values of the dual, whose increase may be small beside it.
  void set_precise(bool precise) { precise_ = precise; }
  bool density_varies() const { return !density_.is_constant(); }

  /// Whether weights pass a necessary condition for nonempty cells: the weights of two nonempty cells differ
  /// by at most the squared distance from a seed to the farthest point. Allows four times that, and for
  /// weights that violate it from the beginning, as given ones may, four times their range.
  /// \param before  the weights at which the step starts
  bool plausible(const Vector& weights, const Vector& before) const;

  std::size_t size() const { return positions_.size() / dimension_; }
  std::span<const double> positions() const { return positions_; }
  Diagram& diagram() { return diagram_; }
  /// The geometry of the cells of the last weights; counts as a diagram.
  const Cells& cells() {
    ++diagrams_;
    return diagram_.cells();
  }
  const Vector& last_weights() const { return last_weights_; }  ///< those that the diagram has
  std::size_t diagrams() const { return diagrams_; }            ///< computed so far
  double seconds() const { return seconds_; }                   ///< wall-clock time of these

 private:
  /// Computes cells and conductances of at.weights.
  void measure(Iterate& at);
  double integral_tolerance(double error) const;
  DensityIntegrals integrate_density();
  DensityIntegrals integrate_blend();

  Diagram& diagram_;
  const Density& density_;
  std::span<const double> positions_;
  std::size_t dimension_;
  Goal goal_;
  int threads_;
  double expected_error_ = 1;  // of the next weights
  bool precise_ = false;
  double spread_ = 0;
  std::optional<Density> uniform_;  // constant, with the same mass
  Vector last_weights_;
  std::size_t diagrams_ = 0;
  double seconds_ = 0;
};

/// Conductances of `walls`, parallel to walls.wall. On a surface a wall crosses many triangles and moves at a
/// different speed in each, which takes the geometry of the cells.
std::vector<double> conductances(Diagram& diagram, const Adjacency& walls, std::span<const double> positions);

/// Sets the conductances in a periodic domain. Joins the walls of two seeds through several images into one,
/// and removes those of a seed with images of itself, which no weight moves.
void join_images(const Domain& domain, std::span<const double> positions, Iterate& at);

}  // namespace powercell
