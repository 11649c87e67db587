/// \file
/// Symmetric systems of a weighted graph, L_ij = -c_ij and L_ii = s_i + sum_j c_ij with c, s >= 0, and what
/// solves them. Internal.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <powercell/linear_solver.hpp>
#include <span>
#include <vector>

namespace powercell {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;
using Vector = Eigen::VectorXd;

/// The matrix of one system.
struct Laplacian {
  SparseRows matrix;  ///< compressed, with the diagonal; columns ascend within a row
  /// All s_i are 0: the constants solve L x = 0, and right sides and solutions have the mean 0.
  bool singular = true;
};

/// \param offset, neighbor  n + 1 and m: symmetric rows, ascending, without the diagonal
/// \param conductance       m: c_ij
/// \param shift             n: s_i; empty means 0
/// \throw Error unsupported with 2^31 entries or more
Laplacian make_laplacian(std::span<const std::uint64_t> offset, std::span<const std::uint32_t> neighbor,
                         std::span<const double> conductance, std::span<const double> shift);

/// The number of connected parts of the graph of the entries that are not 0.
std::size_t connected_parts(const SparseRows& matrix);

/// A solution, and how it was found.
struct LinearResult {
  Vector solution;                                ///< of mean 0 where the system is singular
  LinearSolver solver = LinearSolver::automatic;  ///< never automatic
  int iterations = 0;                             ///< 0 where it is direct
  double residual = 0;                            ///< |b - L x| / |b|
  /// There is no solution, and the one here means nothing: to rounding the matrix has a null space, or
  /// numbers leave the range of doubles.
  bool broke_down = false;
};

/// Solves L x = b. A singular system must be connected; the mean of b is taken off first.
/// \param solver     which; automatic chooses by size and dimension (docs/applications.md, "Transport")
/// \param tolerance  of the residual, for the iteration
/// \param dimension  of the cells: what a factorisation fills in depends on it
LinearResult solve_laplacian(const Laplacian& system, const Vector& right, LinearSolver solver,
                             double tolerance, int dimension);

}  // namespace powercell
