/// \file
/// Means and covariances, and the transport between normal distributions. Internal.
#pragma once

#include <Eigen/Core>
#include <span>

namespace powercell {

using Place = Eigen::Vector3d;  ///< third coordinate 0 in 2D

Place place(std::span<const double> positions, std::size_t i, std::size_t d);

/// Mean and covariance of a distribution.
struct Normal {
  Place mean = Place::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Accumulates a distribution about a given origin, near its mean lest the covariance cancel.
class NormalSum {
 public:
  explicit NormalSum(Place origin = Place::Zero()) : origin_(std::move(origin)) {}
  void add(double mass, const Place& x) { add(mass, x - origin_, (x - origin_) * (x - origin_).transpose()); }
  /// \param mean, square  of x and x xᵀ relative to the origin
  void add(double mass, const Place& mean, const Eigen::Matrix3d& square) {
    mass_ += mass;
    first_ += mass * mean;
    second_ += mass * square;
  }
  const Place& origin() const { return origin_; }
  double mass() const { return mass_; }
  Normal normal() const {
    const Place mean = first_ / mass_;
    return {origin_ + mean, second_ / mass_ - mean * mean.transpose()};
  }

 private:
  Place origin_;
  double mass_ = 0;
  Place first_ = Place::Zero();
  Eigen::Matrix3d second_ = Eigen::Matrix3d::Zero();
};

/// The linear part of the optimal transport between normal distributions, (31b): symmetric; 0 in directions
/// in which `from` has no extent.
Eigen::Matrix3d linear_transport(const Normal& from, const Normal& to);

}  // namespace powercell
