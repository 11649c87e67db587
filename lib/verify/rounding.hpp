/// \file
/// How far rounding may move what a diagram computes. Internal.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/options.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

#include "lib/domain/measure.hpp"

namespace powercell {

/// Longest edge of the domain's box.
double extent_of(const Domain& domain);

/// Length of the edges of a wall of this area, which is at most as many times longer than wide as the domain;
/// of a wall that is a line, its two ends.
double rim_of(double wall, const Domain& domain);

/// A cell computed with unit roundoff u is the exact one for planes moved by a few tens of u times the
/// lengths that enter: how far the domain reaches from the seed, the distance |q| to the other seed, and the
/// part of the bisector's offset that comes from the weights, |w_i - w_j| / |q|. Coordinates given back are
/// rounded to double once more.
class Rounding {
 public:
  Rounding(const Domain& domain, const SeedsView& seeds, Precision precision);

  const SeedsView& seeds() const { return seeds_; }
  double unit() const { return unit_; }  ///< u: 2^-53 or 2^-24
  double diagonal() const { return diagonal_; }
  /// Of a cell that is decided to be there; in double precision as good as 0 (Clipper::write_moments).
  double least_measure(int cell_dimension) const;
  /// Distance from seed i to the farthest corner of the domain's box.
  double reach(std::size_t i) const;
  /// How far a plane of cell i that is a facet of the domain may be off.
  double shift(std::size_t i) const;
  /// The same for a plane with `border` behind it.
  double shift(std::size_t i, const Border& border) const;
  double wall_shift(std::size_t i, std::size_t j) const;

  Vector position(std::size_t i) const;
  long double weight(std::size_t i) const { return seeds_.weights.empty() ? 0.0L : seeds_.weights[i]; }
  /// Signed distance from x, relative to seed i, to the bisector of i and j, positive on j's side.
  long double beyond(std::size_t i, std::size_t j, const Vector& x) const;

 private:
  SeedsView seeds_;
  std::array<double, 3> low_, high_;
  double unit_, diagonal_ = 0, coordinate_ = 0;
};

}  // namespace powercell
