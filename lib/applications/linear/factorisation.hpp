/// \file
/// Sparse Cholesky factors of Laplacians that may be singular.
#pragma once

#include <Eigen/SparseCholesky>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

/// LDL^T factors of a Laplacian. A singular one is grounded: factorised without its last row and column,
/// which leaves a positive definite matrix if the graph is connected.
class Factorisation {
 public:
  /// \return whether all pivots are nonzero in spite of rounding
  [[nodiscard]] bool compute(const SparseRows& matrix, bool singular);
  /// Solves L x = b. If the system is singular, the mean of b is subtracted first and x has the mean 0.
  void solve(const Vector& b, Vector& x) const;

 private:
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors_;
  bool singular_ = false;
};

}  // namespace powercell
