#include "lib/applications/treemap/laplacian.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell::treemap_detail {
namespace {

constexpr std::size_t dense_unknowns = 64;  // up to which dense factors are faster

/// Calls add(i, j, a_ij / (4 |p_i - p_j|)) for each side of each wall: half of (15), as each wall has two
/// sides.
template <class Add>
void each_wall(const Walls& walls, const Add& add) {
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k) {
      const std::size_t j = walls.neighbor[k];
      const double x = walls.x[i] - walls.x[j], y = walls.y[i] - walls.y[j];
      add(i, j, walls.wall[k] / (4 * std::sqrt(x * x + y * y)));
    }
}

}  // namespace

struct LaplacianSolver::Storage {
  Eigen::MatrixXd dense;
  Eigen::VectorXd unknown;
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  Laplacian sparse;

  /// Fixes the last unknown to 0, so its row and column are left out.
  bool solve_dense(const Walls& walls, std::span<const double> residual) {
    const auto m = static_cast<Eigen::Index>(walls.size() - 1);
    dense.setZero(m, m);
    each_wall(walls, [&](std::size_t i, std::size_t j, double half) {
      const auto a = static_cast<Eigen::Index>(std::max(i, j)), b = static_cast<Eigen::Index>(std::min(i, j));
      dense(b, b) += half;
      if (a == m) return;
      dense(a, a) += half;
      dense(a, b) -= half;
    });
    unknown = Eigen::Map<const Eigen::VectorXd>(residual.data(), m + 1);
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(dense);
    if (factors.info() != Eigen::Success) return false;
    auto head = unknown.head(m);
    factors.solveInPlace(head);
    unknown[m] = 0;
    return true;
  }

  bool solve_sparse(const Walls& walls, std::span<const double> residual) {
    const auto n = static_cast<Eigen::Index>(walls.size());
    entries.clear();
    each_wall(walls, [&](std::size_t i, std::size_t j, double half) {
      const auto a = static_cast<std::int32_t>(i), b = static_cast<std::int32_t>(j);
      entries.emplace_back(a, a, half);
      entries.emplace_back(b, b, half);
      entries.emplace_back(a, b, -half);
      entries.emplace_back(b, a, -half);
    });
    sparse.matrix.resize(n, n);
    sparse.matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(residual.data(), n);
    constexpr double unused_tolerance = 0;  // a direct solver has none
    const LinearResult found = solve_laplacian(sparse, right, LinearSolver::direct, unused_tolerance, 2);
    unknown = found.solution;
    return !found.broke_down;
  }
};

LaplacianSolver::LaplacianSolver() : storage_(std::make_unique<Storage>()) {}
LaplacianSolver::~LaplacianSolver() = default;

bool LaplacianSolver::solve(const Walls& walls, std::span<const double> residual,
                            std::vector<double>& delta) {
  const bool solved = walls.size() <= dense_unknowns + 1 ? storage_->solve_dense(walls, residual)
                                                         : storage_->solve_sparse(walls, residual);
  if (solved) delta.assign(storage_->unknown.begin(), storage_->unknown.end());
  return solved;
}

}  // namespace powercell::treemap_detail
