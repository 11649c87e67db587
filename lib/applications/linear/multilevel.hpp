/// \file
/// A multilevel preconditioner for Laplacians: smoothed aggregation. Internal.
#pragma once

#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

/// Smoothed aggregation (Vanek, Mandel, Brezina 1996): unknowns that are strongly coupled are joined, the
/// constants on the joined sets are smoothed once by Jacobi, and the Galerkin product is the next level. One
/// application is a V-cycle with a Gauss-Seidel sweep forward on the way down and backward on the way
/// up, so it is symmetric, and always the same bits.
class Multilevel {
 public:
  explicit Multilevel(const Laplacian& system);

  /// The matrix of the last level has a null space, to rounding: there is nothing to apply.
  bool broke_down() const { return broke_down_; }
  /// z = M r
  void apply(const Vector& r, Vector& z);

  std::size_t levels() const { return levels_.size() + 1; }
  /// Entries of all levels by those of the first.
  double complexity() const { return complexity_; }

 private:
  struct Level {
    SparseRows matrix, prolong, restrict_;
    Vector inverse_diagonal, right, solution, residual;
  };
  void cycle(std::size_t level, const SparseRows& matrix, const Vector& r, Vector& z);

  const SparseRows* finest_;
  std::vector<Level> levels_;  // level k leads from level k to k + 1; levels_[0].matrix is not used
  SparseRows coarsest_matrix_;
  bool singular_, broke_down_ = false;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> coarsest_;
  double complexity_ = 1;
};

}  // namespace powercell
