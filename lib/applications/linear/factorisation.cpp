#include "lib/applications/linear/factorisation.hpp"

namespace powercell {

bool Factorisation::compute(const SparseRows& matrix, bool singular) {
  singular_ = singular;
  const Eigen::Index n = matrix.rows() - (singular ? 1 : 0);
  if (n == 0) return true;
  const Eigen::SparseMatrix<double> columns = matrix.topLeftCorner(n, n);  // symmetric, so rows are columns
  factors_.compute(columns);
  return factors_.info() == Eigen::Success;
}

void Factorisation::solve(const Vector& b, Vector& x) const {
  const Eigen::Index n = b.size() - (singular_ ? 1 : 0);
  x.setZero(b.size());
  if (n == 0) return;
  if (!singular_) {
    x = factors_.solve(b);
    return;
  }
  x.head(n) = factors_.solve(Vector(b.head(n).array() - b.mean()));
  x.array() -= x.mean();
}

}  // namespace powercell
