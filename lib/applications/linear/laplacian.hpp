/// \file Laplacians of weighted graphs, L_ij = -c_ij and L_ii = s_i + sum_j c_ij with c, s >= 0, and the
/// solution of linear systems with them.
#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <powercell/linear_solver.hpp>
#include <span>
#include <vector>

namespace powercell {

using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t>;
using Vector = Eigen::VectorXd;

struct Laplacian {
  SparseRows matrix;  ///< compressed, including the diagonal; columns ascend within a row
  /// All s_i are 0: constants solve L x = 0, and right-hand sides and solutions have the mean 0.
  bool singular = true;
};

/// Assembles the matrix of n unknowns.
/// \param offset, neighbor  n + 1 and m: rows of a symmetric graph, ascending, without the diagonal
/// \param conductance       m: c_ij
/// \param shift             n: s_i; empty means 0
/// \param beyond            columns behind the n: of neighbours whose rows are elsewhere
/// \throw Error unsupported for 2^31 entries or more
Laplacian make_laplacian(std::span<const std::uint64_t> offset, std::span<const std::uint32_t> neighbor,
                         std::span<const double> conductance, std::span<const double> shift,
                         std::size_t beyond = 0);

/// The number of connected components of the graph of nonzero entries.
std::size_t connected_components(const SparseRows& matrix);

/// Solution of a linear system.
struct LinearResult {
  Vector solution;                                ///< with mean 0 if the system is singular
  LinearSolver solver = LinearSolver::automatic;  ///< the solver used, never automatic
  int iterations = 0;                             ///< 0 for a direct solver
  double residual = 0;                            ///< |b - L x| / |b|
  /// No solution was found and `solution` is meaningless: up to rounding the matrix has a null space, or
  /// values leave the range of doubles.
  bool broke_down = false;
};

/// Solves L x = b. A singular system must be connected; the mean of b is subtracted first.
/// \param solver     automatic chooses by size and dimension (docs/applications.md, "Transport")
/// \param tolerance  of the relative residual of an iterative solver
/// \param dimension  of the cells, on which the fill-in of a factorisation depends
LinearResult solve_laplacian(const Laplacian& system, const Vector& right, LinearSolver solver,
                             double tolerance, int dimension);

}  // namespace powercell
