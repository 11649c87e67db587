/// \file
/// Evaluation of weights: the masses of their cells and the derivatives.
#pragma once

#include <powercell/transport.hpp>

#include "lib/applications/linear/laplacian.hpp"
#include "lib/applications/transport/all_seeds.hpp"

namespace powercell {

/// Relative error to which the masses of blended densities are solved: enough to start the next blend from.
inline constexpr double blend_tolerance = 0.1;
/// min m_i / v_i below which Newton's method makes no progress, unless by intermediate masses.
inline constexpr double hopeless_share = 1e-3;

/// Weights with everything that is evaluated at them. v are target masses. Arrays are those of the seeds
/// here, numbers of all seeds.
struct Iterate {
  const AllSeeds* all = nullptr;
  Vector weights;  ///< with mean 0 over all seeds
  /// Weights of seeds elsewhere: neighbour weights.size() + k is the k-th of them.
  Vector beyond;
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
    return all->greatest_of(rounding().array() / target.array());
  }
  /// min m_i / v_i
  double least(const Vector& target) const;
  /// Whether a cell is empty or far below its mass.
  bool is_poor(const Vector& target) const { return empty > 0 || least(target) < hopeless_share; }
  /// Whether fewer cells are empty, or of as many the least share is larger.
  bool is_better(const Iterate& other, const Vector& target) const {
    return empty < other.empty || (empty == other.empty && least(target) > other.least(target));
  }
  /// v - m, the gradient of the dual
  Vector gradient(const Vector& target) const { return target - mass(); }
  /// |v - m|
  double gradient_norm(const Vector& target) const { return all->norm(gradient(target)); }
  /// The matrix of (27), plus a diagonal `shift` unless that is empty.
  Laplacian laplacian(std::span<const double> shift = {}) const;
  /// Sum of the second moments.
  double primal() const;
  /// (26)
  double dual(const Vector& target) const;
};

class DiagramEvaluator;

/// Evaluates weights of the seeds of a transport, and solves the systems of its steps.
class Evaluator {
 public:
  /// All are kept, the last two by reference.
  /// \param positions  n x d, of the seeds here
  Evaluator(Domain domain, std::span<const double> positions, const AllSeeds& all);
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;
  virtual ~Evaluator() = default;

  /// Subtracts the mean from the weights and evaluates them.
  Iterate evaluate(Vector weights);
  /// Whether weights pass a necessary condition for nonempty cells: the weights of two nonempty cells differ
  /// by at most the squared distance from a seed to the farthest point. Allows four times that, and for
  /// weights that violate it from the beginning, as given ones may, four times their range.
  /// \param before  the weights at which the step starts
  bool plausible(const Vector& weights, const Vector& before) const;

  /// Whether nonzero entries of a matrix of Iterate::laplacian connect all seeds.
  virtual bool connects_all(const Laplacian& system) = 0;
  /// Solves system x = right.
  virtual LinearResult solve(const Laplacian& system, const Vector& right) = 0;
  /// With what takes all seeds in one place; null where they are on several ranks.
  virtual DiagramEvaluator* in_one_place() { return nullptr; }
  /// The share of the domain's mass that is replaced by a uniform density.
  virtual double spread() const { return 0; }
  virtual bool density_varies() const { return false; }
  /// Whether integrals must be accurate enough for the result whatever the error of the masses. For phases
  /// that compare values of the dual, whose increase may be small beside it.
  virtual void set_precise(bool) {}

  const AllSeeds& all() const { return all_; }
  std::size_t count() const { return count_; }  ///< of all seeds
  const Domain& domain() const { return domain_; }
  std::size_t dimension() const { return dimension_; }
  std::span<const double> positions() const { return positions_; }
  /// The box of all seeds: the least coordinates and the greatest.
  const std::vector<double>& low() const { return low_; }
  const std::vector<double>& high() const { return high_; }
  std::size_t diagrams() const { return diagrams_; }  ///< computed so far
  /// Adds the diagrams of another evaluator.
  void count_diagrams(const Evaluator& of) {
    diagrams_ += of.diagrams_;
    seconds_ += of.seconds_;
  }
  double seconds() const { return seconds_; }  ///< wall-clock time of these

 protected:
  /// Computes cells and conductances of at.weights.
  virtual void measure(Iterate& at) = 0;
  void count_diagram() { ++diagrams_; }

 private:
  Domain domain_;
  std::span<const double> positions_;
  std::size_t dimension_;
  const AllSeeds& all_;
  std::size_t count_;
  std::vector<double> low_, high_;
  std::size_t diagrams_ = 0;
  double seconds_ = 0;
};

}  // namespace powercell
