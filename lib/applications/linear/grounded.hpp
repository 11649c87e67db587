/// \file
/// Factorisation of Laplacians that may be singular. Internal.
#pragma once

#include <Eigen/SparseCholesky>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

using Factorisation = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

/// Factorises the matrix, or where it is singular the matrix without its last row and column, which is
/// positive definite if the graph is connected. Returns whether rounding left all pivots other than 0.
[[nodiscard]] bool factorise(const SparseRows& matrix, bool singular, Factorisation& factors);
/// x with L x = b, of mean 0 where singular; the sum of b counts as 0 there.
void solve_factorised(const Factorisation& factors, bool singular, const Vector& b, Vector& x);

}  // namespace powercell
