/// \file
/// The damped Newton method for weights that give cells prescribed areas.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "lib/applications/treemap/convex_diagram.hpp"

namespace powercell::treemap_detail {

struct NewtonOutcome {
  bool converged = false;
  /// Largest |m_i / v_i - 1| at the weights found; infinity if a cell is empty, even with equal weights.
  double error = std::numeric_limits<double>::infinity();
  int steps = 0;
  int diagrams = 0;
};

/// Kitagawa, Mérigot, Thibert 2019; (27)-(29) of docs/mathematics.md.
/// \param diagram    with outline and seeds; left with the cells of the weights found
/// \param target     areas v_i, above 0
/// \param weights    the start, then the weights found
/// \param tolerance  of every |m_i / v_i - 1|
NewtonOutcome damped_newton(ConvexDiagram& diagram, LaplacianSolver& laplacian,
                            std::span<const double> target, std::vector<double>& weights, double tolerance);

}  // namespace powercell::treemap_detail
