#include "lib/applications/linear/multilevel.hpp"

#include <algorithm>

namespace powercell {
namespace {

constexpr Eigen::Index coarsest_size = 400;  // unknowns; a direct solve of so few costs less than more levels
// A level that would keep more than this share of the unknowns is not made.
constexpr double least_coarsening = 0.7;
// Weight of the Jacobi step that smooths the prolongation: 4/3 over the largest eigenvalue of D^-1 L, which
// is at most 2 for diagonally dominant matrices.
constexpr double jacobi_weight = 2.0 / 3.0;

/// (I - w D^-1 A_F) P for the piecewise constant P, where A_F is the matrix with its weak entries moved to
/// the diagonal.
SparseRows smoothed_prolongation(const SparseRows& matrix, const Aggregates& aggregates) {
  const Eigen::Index n = matrix.rows();
  SparseRows prolong(n, aggregates.count);
  prolong.reserve(matrix.nonZeros());
  const std::int32_t* const outer = matrix.outerIndexPtr();
  const std::int32_t* const inner = matrix.innerIndexPtr();
  const double* const value = matrix.valuePtr();
  std::vector<double> sum(static_cast<std::size_t>(aggregates.count));
  std::vector<std::int32_t> touched;
  const auto add = [&](std::int32_t aggregate, double term) {
    double& entry = sum[static_cast<std::size_t>(aggregate)];
    if (entry == 0) touched.push_back(aggregate);
    entry += term;
  };
  for (std::int32_t i = 0; i < n; ++i) {
    double strong = 0, all = 0;
    for (std::int32_t k = outer[i]; k < outer[i + 1]; ++k) {
      all += value[k];
      if (aggregates.strong[static_cast<std::size_t>(k)]) strong -= value[k];
    }
    const double diagonal = strong + std::max(all, 0.0);
    const std::int32_t own = aggregates.of[static_cast<std::size_t>(i)];
    add(own, diagonal > 0 ? 1 - jacobi_weight : 1.0);
    for (std::int32_t k = outer[i]; k < outer[i + 1]; ++k)
      if (aggregates.strong[static_cast<std::size_t>(k)])
        add(aggregates.of[static_cast<std::size_t>(inner[k])], -jacobi_weight / diagonal * value[k]);
    std::sort(touched.begin(), touched.end());
    prolong.startVec(i);
    for (const std::int32_t aggregate : touched) {
      prolong.insertBackByOuterInner(i, aggregate) = sum[static_cast<std::size_t>(aggregate)];
      sum[static_cast<std::size_t>(aggregate)] = 0;
    }
    touched.clear();
  }
  prolong.finalize();
  return prolong;
}

/// One Gauss-Seidel update: solves row i for x_i.
void update(const SparseRows& matrix, const Vector& inverse_diagonal, const Vector& right, Vector& x,
            Eigen::Index i) {
  double sum = right[i];
  for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
    if (entry.col() != i) sum -= entry.value() * x[entry.col()];
  x[i] = sum * inverse_diagonal[i];
}

}  // namespace

Multilevel::Multilevel(const Laplacian& system) : finest_(&system.matrix), singular_(system.singular) {
  const SparseRows* matrix = finest_;
  double entries = static_cast<double>(matrix->nonZeros());
  while (matrix->rows() > coarsest_size) {
    const Aggregates aggregates = aggregate(*matrix, static_cast<int>(levels_.size()));
    if (aggregates.count >= least_coarsening * static_cast<double>(matrix->rows())) break;
    Level level;
    level.prolong = smoothed_prolongation(*matrix, aggregates);
    level.restrict_ = level.prolong.transpose();
    const SparseRows product = *matrix * level.prolong;
    SparseRows coarse = level.restrict_ * product;
    level.inverse_diagonal = matrix->diagonal().cwiseInverse();
    if (!levels_.empty()) level.matrix = std::move(coarsest_matrix_);
    levels_.push_back(std::move(level));
    coarsest_matrix_ = std::move(coarse);
    matrix = &coarsest_matrix_;
    entries += static_cast<double>(matrix->nonZeros());
  }
  complexity_ = entries / static_cast<double>(finest_->nonZeros());
  broke_down_ = !coarsest_.compute(*matrix, singular_);
}

void Multilevel::cycle(std::size_t at, const SparseRows& matrix, const Vector& r, Vector& z) {
  if (at == levels_.size()) {
    coarsest_.solve(r, z);
    return;
  }
  Level& level = levels_[at];
  z.setZero(r.size());
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) update(matrix, level.inverse_diagonal, r, z, i);
  level.residual = r;
  level.residual.noalias() -= matrix * z;
  level.right.noalias() = level.restrict_ * level.residual;
  const SparseRows& next = at + 1 < levels_.size() ? levels_[at + 1].matrix : coarsest_matrix_;
  cycle(at + 1, next, level.right, level.solution);
  z.noalias() += level.prolong * level.solution;
  for (Eigen::Index i = matrix.rows(); i-- > 0;) update(matrix, level.inverse_diagonal, r, z, i);
}

void Multilevel::apply(const Vector& r, Vector& z) {
  cycle(0, *finest_, r, z);
  if (singular_) z.array() -= z.mean();
}

}  // namespace powercell
