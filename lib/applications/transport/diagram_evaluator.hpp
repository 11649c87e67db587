/// \file
/// Evaluation of weights whose seeds are all in one diagram.
#pragma once

#include <optional>

#include "lib/applications/transport/evaluator.hpp"

namespace powercell {

/// The masses to solve for and their tolerance. Refers to the target.
struct Goal {
  const Vector& target;
  double tolerance;
};

class DiagramEvaluator : public Evaluator {
 public:
  /// All but the goal are kept by reference.
  /// \param positions  n x d, those of the diagram
  /// \param options    of its density, linear solver and threads
  DiagramEvaluator(Diagram& diagram, std::span<const double> positions, const Goal& goal,
                   const TransportOptions& options);

  DiagramEvaluator* in_one_place() override { return this; }
  bool connects_all(const Laplacian& system) override;
  LinearResult solve(const Laplacian& system, const Vector& right) override;

  /// Sets the share of the domain's mass that is replaced by a uniform density, (31c). The density must not
  /// be constant.
  void set_spread(double share);
  double spread() const override { return spread_; }
  void set_precise(bool precise) override { precise_ = precise; }
  bool density_varies() const override { return !options_.density.is_constant(); }

  std::size_t size() const { return count(); }
  /// The geometry of the cells of the last weights; counts as a diagram.
  const Cells& cells() {
    count_diagram();
    return diagram_.cells();
  }
  Diagram& diagram() { return diagram_; }
  const TransportOptions& options() const { return options_; }
  const Vector& last_weights() const { return last_weights_; }  ///< those that the diagram has

 private:
  void measure(Iterate& at) override;
  double integral_tolerance(double error) const;
  DensityIntegrals integrate_density();
  DensityIntegrals integrate_blend();

  Diagram& diagram_;
  const TransportOptions& options_;
  Goal goal_;
  double expected_error_ = 1;  // of the next weights
  bool precise_ = false;
  double spread_ = 0;
  std::optional<Density> uniform_;  // constant, with the same mass
  Vector last_weights_;
};

/// Conductances of `walls`, parallel to walls.wall. On a surface a wall crosses many triangles and moves at a
/// different speed in each, which takes the geometry of the cells.
std::vector<double> conductances(Diagram& diagram, const Adjacency& walls, std::span<const double> positions);

/// The same for walls in planes, from the positions of all seeds that are neighbours.
/// \param d  the dimension
std::vector<double> plane_conductances(const Adjacency& walls, std::span<const double> positions,
                                       std::size_t d);

/// Sets the conductances in a periodic domain. Joins the walls of two seeds through several images into one,
/// and removes those of a seed with images of itself, which no weight moves.
void join_images(const Domain& domain, std::span<const double> positions, Iterate& at);

}  // namespace powercell
