/// \file
/// What the descents of sampling share. Internal.
#pragma once

#include <powercell/sampling.hpp>
#include <powercell/transport.hpp>

#include "lib/applications/sampling/spacing.hpp"

namespace powercell {

/// Points, and the cells of equal mass that they have. Evaluating is the expensive part.
class SamplingState {
 public:
  /// \param positions  n x d
  SamplingState(const Device& device, const Domain& domain, const SamplingOptions& options,
                std::vector<double> positions);

  /// Moves the points and finds the weights again. \param tolerance  of the capacities
  void move_to(std::vector<double> positions, double tolerance);
  /// Where each point's cell has its centroid, n x d; the point itself where a cell is empty.
  std::vector<double> centroids() const;
  /// dE/dp = 2 m_i (p_i - c_i), n x d (mathematics, (36)).
  std::vector<double> energy_gradient() const;
  /// Root mean square of |c_i - p_i|.
  double distance_to_centroids() const;
  /// In the plane.
  Surroundings surroundings() const;
  /// max |m_i / (M/n) - 1|
  double capacity_error() const;
  /// Points outside the domain go to the nearest place of their own cell, on surfaces all points.
  /// \param at_centroids  of the cells that they have
  std::vector<double> in_domain(bool at_centroids);
  /// The points again, in the box where that is periodic.
  std::vector<double> wrapped() const;
  /// Energy over that of the best lattice.
  double relative_energy() const;

  std::size_t size() const { return positions_.size() / dimension_; }
  std::size_t dimension() const { return dimension_; }
  const std::vector<double>& positions() const { return positions_; }
  double energy() const { return cells().dual; }
  const TransportResult& cells() const { return solver_.result(); }

 private:
  const Device& device_;
  const Domain& domain_;
  const SamplingOptions& options_;
  std::size_t dimension_;
  std::vector<double> positions_;
  mutable TransportSolver solver_;
};

/// One iteration by L-BFGS keeps this much.
class LbfgsMemory {
 public:
  /// The direction from gradient g, -H g, with H0 = 1 / (2 m_i) (mathematics, (37)).
  std::vector<double> direction(const std::vector<double>& gradient,
                                const std::vector<double>& inverse_diagonal) const;
  /// A step and the change of the gradient over it; left out where it has no positive curvature.
  void add(std::vector<double> step, std::vector<double> change);
  void forget() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

 private:
  static constexpr std::size_t kept = 7;
  struct Pair {
    std::vector<double> step, change;
    double curvature;  // their product
  };
  std::vector<Pair> pairs_;  // oldest first
};

}  // namespace powercell
