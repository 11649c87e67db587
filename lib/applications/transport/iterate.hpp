/// \file
/// Weights with the masses of their cells: where the solver stands. Internal.
#pragma once

#include <optional>
#include <powercell/transport.hpp>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

/// To what masses of blended densities are met.
inline constexpr double blended_tolerance = 0.1;

/// A point of the course, evaluated.
struct Iterate {
  Vector weights;  // of mean 0
  DensityIntegrals cells;
  /// As cells.walls: c_ij = -dm_i/dw_j (mathematics, (15)). None where the masses are met and walls cost
  /// extra.
  std::vector<double> conductance;
  std::size_t empty = 0;  // cells without mass

  Eigen::Map<const Vector> mass() const {
    return {cells.mass.data(), static_cast<Eigen::Index>(cells.mass.size())};
  }
  /// max |m_i / v_i - 1|
  double error(const Vector& target) const;
  /// The largest error of a cell's integral over v_i.
  double quadrature_error(const Vector& target) const;
  /// min m_i / v_i
  double least(const Vector& target) const;
  /// v - m, the gradient of the dual
  Vector gradient(const Vector& target) const { return target - mass(); }
  double primal() const;
  /// (26)
  double dual(const Vector& target) const;
};

/// What a solve is after. Kept by reference.
struct Goal {
  const Vector& target;
  double tolerance;
};

/// Evaluates weights of the seeds that a diagram has.
class Evaluator {
 public:
  /// The first three are kept by reference. \param positions  n x d, those of the diagram
  /// \param threads  for the integrals; 0 means all
  Evaluator(Diagram& diagram, const Density& density, std::span<const double> positions, const Goal& goal,
            int threads);
  virtual ~Evaluator() = default;

  /// The diagram keeps these weights. Their mean is taken off first.
  Iterate evaluate(Vector weights);

  /// From now on this share of the domain's mass is spread evenly over it: the density is (31c). Not for
  /// constants.
  void spread(double share);
  double spread() const { return spread_; }
  /// From now on integrals are good enough for the result, whatever the error: for what looks at the dual,
  /// whose rise may be small beside it.
  void precise(bool on) { precise_ = on; }
  bool uneven() const { return !density_.is_constant(); }

  /// Whether weights may have cells that are not empty: of two of those the weights differ by no more than
  /// the square of the way from a seed to the farthest point. Generous, and for weights that differ more than
  /// is possible already, as given ones may, no more than four times as much. \param before  where the step
  /// starts
  bool possible(const Vector& weights, const Vector& before) const;

  std::size_t size() const { return positions_.size() / dimension_; }
  std::span<const double> positions() const { return positions_; }
  Diagram& diagram() { return diagram_; }
  std::size_t count() const { return count_; }  ///< diagrams so far
  const Vector& last() const { return last_; }  ///< weights that the diagram has
  double seconds() const { return seconds_; }   ///< wall clock in them

 protected:
  /// Cells and conductances of at.weights.
  virtual void measure(Iterate& at);

 private:
  double needed(double error) const;
  DensityIntegrals integrate_as_needed();
  DensityIntegrals integrate_blend();

  Diagram& diagram_;
  const Density& density_;
  std::span<const double> positions_;
  std::size_t dimension_;
  Goal goal_;
  int threads_;
  double expected_ = 1;  // error of the next weights
  bool precise_ = false;
  double spread_ = 0;
  std::optional<Density> even_;  // constant, of the same mass
  Vector last_;
  std::size_t count_ = 0;
  double seconds_ = 0;
};

/// Conductances of `walls`, parallel to walls.wall. On a surface a wall runs through many triangles and moves
/// in each at a speed of its own, which takes the geometry of the diagram's cells.
std::vector<double> conductances(Diagram& diagram, const Adjacency& walls, std::span<const double> positions);

}  // namespace powercell
