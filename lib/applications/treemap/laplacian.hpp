/// \file
/// Linear systems with the derivatives of the areas with respect to the weights.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace powercell::treemap_detail {

/// A view of the walls of a diagram in the plane. Seed i lies at x[i], y[i] and has the walls [offset[i],
/// offset[i+1]). Each wall is listed for both of its seeds; its length may be 0.
struct Walls {
  std::span<const double> x, y;
  std::span<const std::uint64_t> offset;
  std::span<const std::uint32_t> neighbor;
  std::span<const double> wall;
  std::size_t size() const { return offset.size() - 1; }
};

/// Solves L delta = residual with the matrix L of (15) and (27), delta up to a constant. The residual must
/// sum to 0 up to rounding. Dense Cholesky for up to 64 unknowns, which are most groups, sparse beyond.
/// Reuses its memory.
class LaplacianSolver {
 public:
  LaplacianSolver();
  ~LaplacianSolver();
  LaplacianSolver(const LaplacianSolver&) = delete;
  LaplacianSolver& operator=(const LaplacianSolver&) = delete;
  /// \return false if L is not positive definite up to rounding: walls of thin cells may vanish compared with
  ///   others
  bool solve(const Walls& walls, std::span<const double> residual, std::vector<double>& delta);

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace powercell::treemap_detail
