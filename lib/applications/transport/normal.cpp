#include "lib/applications/transport/normal.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace powercell {
namespace {

Eigen::Matrix3d power_of(const Eigen::Matrix3d& symmetric, double exponent) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(symmetric);
  const double least = 1e-12 * of.eigenvalues().cwiseAbs().maxCoeff();
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k)
    if (of.eigenvalues()[k] > least) value[k] = std::pow(of.eigenvalues()[k], exponent);
  return of.eigenvectors() * value.asDiagonal() * of.eigenvectors().transpose();
}

}  // namespace

Place place(std::span<const double> positions, std::size_t i, std::size_t d) {
  Place p = Place::Zero();
  for (std::size_t c = 0; c < d; ++c) p[static_cast<Eigen::Index>(c)] = positions[i * d + c];
  return p;
}

Eigen::Matrix3d linear_transport(const Normal& from, const Normal& to) {
  const Eigen::Matrix3d root = power_of(from.covariance, 0.5), inverse = power_of(from.covariance, -0.5);
  return inverse * power_of(root * to.covariance * root, 0.5) * inverse;
}

}  // namespace powercell
