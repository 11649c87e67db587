/// \file
/// How far rounding may move the results of a diagram.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

#include "lib/domain/measure.hpp"

namespace powercell {

/// The box and the measure of a domain.
struct Extent {
  int cell_dimension = 2;
  std::array<double, 3> low{}, high{};
  double measure = 0;

  double longest() const;  ///< edge of the box
  /// Perimeter of a wall of this area whose ratio of length to width is at most the domain's; for a wall that
  /// is a line, 2 for its ends.
  double rim_of(double wall) const;
};
Extent extent_of(const Domain& domain);

/// A cell computed with unit roundoff u is exact for planes moved by a few tens of u times the lengths
/// involved: the distance from the seed to the farthest corner of the domain, the distance |q| to the other
/// seed, and the part |w_i - w_j| / |q| of the bisector's offset that the weights contribute. Coordinates of
/// results are rounded to double once more.
class Rounding {
 public:
  Rounding(const Extent& extent, const SeedsView& seeds, Precision precision);

  const Extent& extent() const { return extent_; }
  const SeedsView& seeds() const { return seeds_; }
  double unit() const { return unit_; }  ///< u: 2^-53 or 2^-24
  double diagonal() const { return diagonal_; }
  double coordinate() const { return coordinate_; }  ///< rounding of a coordinate in double precision
  /// Measure of the smallest cell known to be non-empty; practically 0 in double precision
  /// (Clipper::write_moments).
  double least_measure(int cell_dimension) const;
  /// Distance from seed i to the farthest corner of the domain's box.
  double reach(std::size_t i) const;
  /// Error of a plane of cell i that is a facet of the domain.
  double shift(std::size_t i) const;
  /// Error of a plane of cell i with `border` behind it.
  double shift(std::size_t i, const Border& border) const;
  /// The same for the bisector of i and j.
  double wall_shift(std::size_t i, std::size_t j) const;
  /// The same if j is the image at `q` from seed i.
  double wall_shift(std::size_t i, std::size_t j, const Vector& q) const;

  Vector position(std::size_t i) const;
  long double weight(std::size_t i) const { return seeds_.weights.empty() ? 0.0L : seeds_.weights[i]; }
  /// The signed distance of x from the bisector of i and j, positive on j's side.
  long double beyond(std::size_t i, std::size_t j, const Vector& x) const;
  /// The same of the point at y from seed i, if j is the image at `q` from seed i.
  long double beyond(std::size_t i, std::size_t j, const Vector& y, const Vector& q) const;

 private:
  Extent extent_;
  SeedsView seeds_;
  double unit_, diagonal_ = 0, coordinate_ = 0;
};

}  // namespace powercell
