/// \file A multilevel preconditioner for Laplacians by smoothed aggregation (Vaněk, Mandel, Brezina 1996).
#pragma once

#include <vector>

#include "lib/applications/linear/factorisation.hpp"

namespace powercell {

/// A partition of the unknowns of a matrix into those of the next coarser level.
struct Aggregates {
  std::int32_t count = 0;
  std::vector<std::int32_t> of;  ///< per unknown: its aggregate
  std::vector<char> strong;      ///< per entry of the matrix, in storage order: whether it couples strongly
};

/// Joins each unknown with its strongly coupled neighbours (algorithm 5.1), in the order of the unknowns.
/// \param level  of the matrix, 0 for the finest: coarser ones count smaller entries as strong
Aggregates aggregate(const SparseRows& matrix, int level);

/// The preconditioner. The prolongation is piecewise constant on the aggregates, smoothed by one Jacobi step;
/// the Galerkin product gives the next level. One application is a V-cycle with a forward Gauss-Seidel sweep
/// on the way down and a backward one on the way up, hence symmetric and deterministic.
class Multilevel {
 public:
  /// \param system  kept by reference
  explicit Multilevel(const Laplacian& system);

  /// Up to rounding the matrix of the coarsest level has a null space; apply() must not be called.
  bool broke_down() const { return broke_down_; }
  /// z = M r
  void apply(const Vector& r, Vector& z);

  std::size_t levels() const { return levels_.size() + 1; }
  /// Operator complexity: the entries of all levels divided by those of the finest.
  double complexity() const { return complexity_; }

 private:
  struct Level {
    SparseRows matrix, prolong, restrict_;
    Vector inverse_diagonal, right, solution, residual;
  };
  void cycle(std::size_t level, const SparseRows& matrix, const Vector& r, Vector& z);

  const SparseRows* finest_;
  std::vector<Level> levels_;  // entry k leads from level k to k + 1; levels_[0].matrix is empty, see finest_
  SparseRows coarsest_matrix_;
  bool singular_, broke_down_ = false;
  Factorisation coarsest_;
  double complexity_ = 1;
};

}  // namespace powercell
