// A host that uses Eigen with flags of its own beside the transport of the static libraries, which use it
// too.
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <cstdio>
#include <powercell/powercell.hpp>
#include <powercell/transport.hpp>

int main() {
  bool right = true;
  for (int k = 1; k < 20; ++k) {
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(k, k), b = a * a.transpose();
    right = right && b.ldlt().solve(Eigen::VectorXd::Ones(k)).norm() > 0;
    Eigen::SparseMatrix<double> s(k, k);
    for (int i = 0; i < k; ++i) s.insert(i, i) = 2 + i;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(s);
    right = right && factors.solve(Eigen::VectorXd::Ones(k)).norm() > 0;
    const Eigen::ConjugateGradient<Eigen::SparseMatrix<double>> gradients(s);
    right = right && gradients.solve(Eigen::VectorXd::Ones(k)).norm() > 0;
  }
  const double low[] = {0, 0}, high[] = {1, 1};
  std::vector<double> positions;
  for (int i = 0; i < 200; ++i)
    positions.push_back(i * 0.7548776662466927 - static_cast<int>(i * 0.7548776662466927));
  const std::vector<double> masses(100, 0.01);
  const auto result = powercell::transport(powercell::Device::choose(), powercell::Domain::box(low, high),
                                           {2, positions, {}}, masses);
  std::printf("Eigen %d, transport %d\n", right, result.converged);
  return right && result.converged ? 0 : 1;
}
