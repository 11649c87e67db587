#include <Eigen/Dense>

#include "lib/applications/linear/multilevel.hpp"

namespace powercell {
namespace {

constexpr Eigen::Index largest_dense = 64;  // unknowns
// Unknowns up to which the factorisation is faster than the iteration, measured (docs/applications.md).
constexpr Eigen::Index largest_direct_plane = 16000, largest_direct_space = 1000;
constexpr int most_iterations = 500;  // 10 to 20 are usual (docs/applications.md)

LinearSolver choose(LinearSolver asked, Eigen::Index n, int dimension) {
  if (asked != LinearSolver::automatic) return asked;
  if (n <= largest_dense) return LinearSolver::dense;
  const Eigen::Index direct = dimension == 2 ? largest_direct_plane : largest_direct_space;
  return n <= direct ? LinearSolver::direct : LinearSolver::multilevel;
}

Vector solve_dense(const Laplacian& system, const Vector& b) {
  const Eigen::Index n = b.size() - (system.singular ? 1 : 0);
  Vector x = Vector::Zero(b.size());
  if (n == 0) return x;
  const Eigen::MatrixXd matrix = Eigen::MatrixXd(system.matrix).topLeftCorner(n, n);
  x.head(n) = matrix.ldlt().solve(b.head(n));
  return x;
}

/// Conjugate gradients (Hestenes, Stiefel 1952) with the multilevel preconditioner.
void iterate(const Laplacian& system, const Vector& b, double tolerance, LinearResult& result) {
  Multilevel preconditioner(system);
  result.broke_down = preconditioner.broke_down();
  if (result.broke_down) return;
  Vector& x = result.solution;
  x.setZero(b.size());
  Vector r = b, z, p, q;
  const double goal = tolerance * b.norm();
  preconditioner.apply(r, z);
  p = z;
  double rz = r.dot(z);
  while (r.norm() > goal && result.iterations < most_iterations && rz > 0) {
    q.noalias() = system.matrix * p;
    const double length = rz / p.dot(q);
    x += length * p;
    r -= length * q;
    ++result.iterations;
    preconditioner.apply(r, z);
    const double next = r.dot(z);
    p = z + (next / rz) * p;
    rz = next;
  }
}

}  // namespace

const char* name(LinearSolver solver) noexcept {
  switch (solver) {
    case LinearSolver::automatic:
      return "automatic";
    case LinearSolver::dense:
      return "dense";
    case LinearSolver::direct:
      return "direct";
    case LinearSolver::multilevel:
      return "multilevel";
  }
  return "unknown";
}

LinearResult solve_laplacian(const Laplacian& system, const Vector& right, LinearSolver solver,
                             double tolerance, int dimension) {
  LinearResult result;
  result.solver = choose(solver, right.size(), dimension);
  Vector b = right;
  if (system.singular) b.array() -= b.mean();
  const double size = b.norm();
  if (size == 0) {
    result.solution = Vector::Zero(b.size());
    return result;
  }
  if (result.solver == LinearSolver::multilevel) {
    iterate(system, b, tolerance, result);
  } else if (result.solver == LinearSolver::dense) {
    result.solution = solve_dense(system, b);
  } else {
    Factorisation factors;
    result.broke_down = !factors.compute(system.matrix, system.singular);
    if (!result.broke_down) factors.solve(b, result.solution);
  }
  result.broke_down = result.broke_down || !result.solution.allFinite();
  if (result.broke_down) return result;
  if (system.singular) result.solution.array() -= result.solution.mean();
  result.residual = (b - system.matrix * result.solution).norm() / size;
  return result;
}

}  // namespace powercell
