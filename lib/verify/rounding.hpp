/// \file
/// Bounds for the rounding errors of a diagram. Internal.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

#include "lib/domain/measure.hpp"

namespace powercell {

/// The longest edge of the domain's bounding box.
double extent_of(const Domain& domain);

/// A bound for the perimeter of a wall of this area, assuming that it is not slimmer than the domain; 2, the
/// number of ends, if walls are lines.
double rim_of(double wall, const Domain& domain);

/// A cell computed with unit roundoff u is exact for planes moved by a few tens of u times the lengths
/// involved: the reach of the domain from the seed, the distance |q| to the other seed, and the part of the
/// bisector's offset that comes from the weights, |w_i - w_j| / |q|. Returned coordinates are rounded to
/// double once more.
class Rounding {
 public:
  Rounding(const Domain& domain, const SeedsView& seeds, Precision precision);

  const SeedsView& seeds() const { return seeds_; }
  double unit() const { return unit_; }  ///< u: 2^-53 or 2^-24
  double diagonal() const { return diagonal_; }
  /// The least measure of a cell known to be non-empty; 0 in double precision (Clipper::write_moments).
  double least_measure(int cell_dimension) const;
  /// Distance from seed i to the farthest corner of the domain's box.
  double reach(std::size_t i) const;
  /// A bound for the error of a plane of cell i that is a facet of the domain.
  double shift(std::size_t i) const;
  /// The same for a plane that is facet or bisector, as `border` says.
  double shift(std::size_t i, const Border& border) const;
  /// The same for the bisector of i and j.
  double wall_shift(std::size_t i, std::size_t j) const;

  Vector position(std::size_t i) const;
  long double weight(std::size_t i) const { return seeds_.weights.empty() ? 0.0L : seeds_.weights[i]; }
  /// The signed distance of x from the bisector of i and j, positive on j's side.
  long double beyond(std::size_t i, std::size_t j, const Vector& x) const;

 private:
  SeedsView seeds_;
  std::array<double, 3> low_, high_;
  double unit_, diagonal_ = 0, coordinate_ = 0;
};

}  // namespace powercell
