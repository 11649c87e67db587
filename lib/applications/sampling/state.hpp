/// \file
/// Points with their cells of equal mass, for the descent methods of sampling.
#pragma once

#include <powercell/sampling.hpp>
#include <powercell/transport.hpp>

#include "lib/applications/sampling/spacing.hpp"

namespace powercell {

/// Points and their cells of equal mass. Moving the points is the expensive operation: it solves a transport.
class SamplingState {
 public:
  /// Device and options are kept by reference.
  /// \param positions  n x d
  SamplingState(const Device& device, const Domain& domain, const SamplingOptions& options,
                std::vector<double> positions);

  /// Replaces the points by others, with weights of 0.
  void restart(std::vector<double> positions);
  /// Moves the points and solves for the weights.
  /// \param tolerance  of the capacities
  /// \param max_steps  limit on Newton steps; the best weights of these are kept
  void move_to(std::vector<double> positions, double tolerance, int max_steps);
  /// Centroids of the cells, n x d; for an empty cell the point itself.
  std::vector<double> centroids() const;
  /// dE/dp_i = 2 m_i (p_i - c_i), n x d, (36).
  std::vector<double> energy_gradient() const;
  /// Root mean square of |c_i - p_i|.
  double distance_to_centroids() const;
  /// \pre the domain is in the plane
  NeighbourStatistics neighbour_statistics() const;
  /// max |m_i / (M/n) - 1|
  double capacity_error() const;
  /// The points, each projected to its own cell.
  /// \param at_centroids  the points are centroids of cells, which needs no projection for convex cells
  std::vector<double> in_domain(bool at_centroids);
  /// The given points, those without density replaced by points of their cells with density. Polygons only;
  /// elsewhere the points as they are.
  std::vector<double> on_density(std::vector<double> positions);
  /// The points, in a periodic domain moved to their copies inside the box.
  std::vector<double> wrapped() const;
  /// Energy relative to that of the best lattice, (38).
  double relative_energy();
  PartsApart parts_apart();

  std::size_t size() const { return positions_.size() / dimension_; }
  std::size_t dimension() const { return dimension_; }
  const std::vector<double>& positions() const { return positions_; }
  double energy() const { return cells().dual; }
  const TransportResult& cells() const { return solver_.result(); }

 private:
  const Device& device_;
  const Domain domain_;
  const SamplingOptions& options_;
  std::size_t dimension_;
  std::vector<double> positions_;
  TransportSolver solver_;
};

}  // namespace powercell
