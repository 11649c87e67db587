#include "lib/applications/linear/grounded.hpp"

namespace powercell {

bool factorise(const SparseRows& matrix, bool singular, Factorisation& factors) {
  const Eigen::Index n = matrix.rows() - (singular ? 1 : 0);
  if (n == 0) return true;
  // Symmetric, so rows are columns.
  const Eigen::SparseMatrix<double> columns = matrix.topLeftCorner(n, n);
  factors.compute(columns);
  return factors.info() == Eigen::Success;
}

void solve_factorised(const Factorisation& factors, bool singular, const Vector& b, Vector& x) {
  const Eigen::Index n = b.size() - (singular ? 1 : 0);
  x.setZero(b.size());
  if (n == 0) return;
  if (!singular) {
    x = factors.solve(b);
    return;
  }
  x.head(n) = factors.solve(Vector(b.head(n).array() - b.mean()));
  x.array() -= x.mean();
}

}  // namespace powercell
