/// \file
/// Bounds of power distances at the corners of a part, and the test that excludes seeds.
///
/// By (11), seed i does not meet a convex part P if some seed j has pow_j(x) < pow_i(x) at all corners of P.
/// Rounding must never exclude a seed that meets P, so the test is  lower_i(x) > upper_j(x)  with bounds that
/// contain the error.
///
/// Let u = 2^-53, D the distance of x from the seed, R the largest distance of a corner of the region from
/// its origin. Corners of the region relative to the origin carry one rounding, each split adds one: with at
/// most 64 splits a corner is off by at most 65 u R along each axis. As |grad (pow_i - pow_j)| = 2 |p_i -
/// p_j| <= 2 (D_i + D_j), that changes the difference by at most 2 sqrt(3) 65 u R (D_i + D_j). The seed
/// relative to the origin is off by u (D + R) at most, which changes D^2 by 2 u (D^2 + R D); subtracting,
/// squaring and summing adds less than 8 u D^2. The weight relative to the reference, and its subtraction,
/// add 2 u |w| and u (D^2 + |w|). Together, for one seed, less than
///     u (16 D^2 + 256 R D + 4 |w|).
/// With the radius s of the part, R D <= (R/s) (D^2 + s^2) / 2 avoids the square root:
///     u ((16 + 128 R/s) D^2 + 128 (R/s) s^2 + 4 |w|).
/// This grows with D and |w|, so the bound for a tree node, with D the distance to its box and w its largest
/// weight, lies below that of every seed in it. After an overflow the comparison is with NaN or between
/// infinities, and excludes nothing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "lib/pairs/column_loops.hpp"
#include "lib/pairs/part.hpp"

namespace powercell::pairs {

inline constexpr int most_splits = 64;
inline constexpr double unit_roundoff = 0x1p-53;

using CornerValues = std::array<double, most_corners>;

/// Bounds of a power distance, given the square of the distance and the weight.
class PowerBounds {
 public:
  PowerBounds() = default;
  /// \param reach   R above
  /// \param radius  s above
  PowerBounds(double reach, double radius) {
    const double ratio = reach / radius;
    square_ = unit_roundoff * (16 + 128 * ratio);
    // The last term bounds the absolute error of subnormal squares.
    constant_ = unit_roundoff * 128 * ratio * radius * radius + 16 * std::numeric_limits<double>::min();
  }
  double lower(double square, double weight) const {
    return square * (1 - square_) - (weight + 4 * unit_roundoff * std::abs(weight) + constant_);
  }
  /// lower() of `count` seeds at `point`, or the lowest double where that is not finite.
  void lower_column(std::size_t count, int dimension, const double* const* column, const double* origin,
                    const double* point, double* to) const {
    loops::powers(count, dimension, column, origin, point, square_, 4 * unit_roundoff, constant_, to);
  }
  double upper(double square, double weight) const {
    return square * (1 + square_) - (weight - 4 * unit_roundoff * std::abs(weight) - constant_);
  }

 private:
  double square_ = 0, constant_ = 0;
};

/// A seed tried for excluding others, with its upper bounds at the corners.
struct Tester {
  std::uint32_t rank;
  CornerValues upper;
};

/// At most one for each corner of a part and one for its centroid.
class Testers {
 public:
  void clear() { count_ = 0; }
  void add(const Tester& tester) { tester_[count_++] = tester; }
  bool contains(std::uint32_t rank) const {
    return std::any_of(begin(), end(), [&](const Tester& t) { return t.rank == rank; });
  }
  const Tester* begin() const { return tester_.data(); }
  const Tester* end() const { return tester_.data() + count_; }

 private:
  std::array<Tester, most_corners + 1> tester_;
  std::size_t count_ = 0;
};

/// Whether upper[v] < lower[v] for all corners v.
inline bool dominates(const CornerValues& upper, const CornerValues& lower, std::size_t corners) {
  for (std::size_t v = 0; v < corners; ++v)
    if (!(upper[v] < lower[v])) return false;
  return true;
}

inline bool excluded(const Testers& testers, const CornerValues& lower, std::size_t corners) {
  for (const Tester& t : testers)
    if (dominates(t.upper, lower, corners)) return true;
  return false;
}

}  // namespace powercell::pairs
