/// \file
/// Linear systems with the derivative of the measures by the weights. Internal.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace powercell::treemap_detail {

/// The walls of a diagram in the plane; nothing is owned. Seed i lies at x[i], y[i] and has the walls
/// [offset[i], offset[i+1]). Each wall stands with both of its seeds; walls of no length may be among them.
struct Walls {
  std::span<const double> x, y;
  std::span<const std::uint64_t> offset;
  std::span<const std::uint32_t> neighbor;
  std::span<const double> wall;
  std::size_t size() const { return offset.size() - 1; }
};

/// Solves L delta = residual, L of mathematics (15) and (27), up to a constant; the residual sums to 0 up to
/// rounding. Dense factors up to 64 unknowns, which is most of all groups, sparse ones beyond; memory is
/// kept.
class LaplacianSolver {
 public:
  LaplacianSolver();
  ~LaplacianSolver();
  LaplacianSolver(const LaplacianSolver&) = delete;
  LaplacianSolver& operator=(const LaplacianSolver&) = delete;
  /// \return false if L is not positive definite to rounding: walls of needles may be lost beside others
  bool solve(const Walls& walls, std::span<const double> residual, std::vector<double>& delta);

 private:
  struct Storage;
  std::unique_ptr<Storage> storage_;
};

}  // namespace powercell::treemap_detail
