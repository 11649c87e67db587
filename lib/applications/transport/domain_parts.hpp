/// \file
/// The connected parts of a domain and how their mass lies. Internal.
#pragma once

#include <Eigen/Core>
#include <array>
#include <powercell/domain.hpp>
#include <span>
#include <utility>
#include <vector>

namespace powercell {

using Place = Eigen::Vector3d;  ///< third coordinate 0 in 2D

Place place(std::span<const double> positions, std::size_t i, std::size_t d);

/// The distribution of a measure along a line.
class Quantiles {
 public:
  Quantiles() = default;
  /// \param atoms  coordinate and measure, in any order
  explicit Quantiles(std::vector<std::pair<double, double>> atoms);
  /// The coordinate below which this share of the measure lies; linear between the middles of the atoms.
  double at(double share) const;

 private:
  std::vector<std::pair<double, double>> knots_;  // share, coordinate
};

/// A part of the domain that interior facets connect.
struct DomainPart {
  double measure = 0;
  Place centroid = Place::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< rows: principal axes, orthonormal
  std::array<Quantiles, 3> quantiles;                  ///< along each axis, relative to the centroid
};

/// The number of connected parts.
std::size_t count_parts(const Domain& domain);
/// The connected parts, at most `most`: smaller ones join the nearest of the largest. Quantiles come from a
/// sample of a few hundred points a part.
std::vector<DomainPart> domain_parts(const Domain& domain, std::size_t most);

}  // namespace powercell
