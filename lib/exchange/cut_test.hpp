/// \file
/// Whether seeds could cut off a vertex of a cell (docs/mathematics.md, "Shards").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace powercell::exchange {

/// The sum of term(k) for the axes k < d, which are 2 or 3. Without a loop, which costs more than short
/// terms.
template <class Term>
double sum_along(std::size_t d, const Term& term) {
  const double plane = term(0) + term(1);
  return d == 2 ? plane : plane + term(2);
}

using Point = std::array<double, 3>;

/// The error of vertices from Diagram::cells(), relative to the farthest one of their cell: more than the
/// proof of its shape leaves (82), and more than the rounding to a float in a request.
constexpr double vertex_error = 0x1p-19;
/// The error of their coordinates, relative to these.
constexpr double coordinate_error = 0x1p-50;
/// More than the rounding of a power distance, relative to its terms.
constexpr double power_error = 0x1p-47;
/// More than what products lose that underflow.
constexpr double underflow = 1e-290;

/// Smaller distances count as this, so that squares do not underflow.
constexpr double least_radius = 1e-145;

/// A point of a cell, seen from the seed of the cell.
class CutTest {
 public:
  /// \param seed    its position, then its weight
  /// \param radius  the distance of the farthest vertex from it, not 0
  CutTest(const double* seed, double radius, int dimension)
      : dimension_(static_cast<std::size_t>(dimension)), weight_(seed[dimension_]) {
    double rounding = 0;
    for (std::size_t k = 0; k < dimension_; ++k) {
      seed_[k] = seed[k];
      rounding += coordinate_error * (std::abs(seed[k]) + radius);
    }
    radius_ = std::max(radius, 8 * rounding);  // so that errors are small beside it
    error_ = vertex_error + rounding / radius_;
    gap_factor_ = 1 - error_ - power_error;
  }

  /// \param y  from the seed
  void move_to(const Point& y) {
    at_ = y;
    double square = 0;
    for (std::size_t k = 0; k < dimension_; ++k) square += y[k] * y[k];
    // (39a), right side
    limit_ = square - weight_ + 3 * error_ * radius_ * radius_ + power_error * (square + std::abs(weight_)) +
             underflow;
  }

  const Point& at() const { return at_; }
  /// Any seed that could cut the point off, or touch it, has a power() of at most this.
  double limit() const { return limit_; }

  /// (39a), left side: of the seed at `position`, or at least this for all seeds in the box from `low` to
  /// `high`, the heaviest of which is given.
  double power(const double* low, const double* high, double heaviest) const {
    const double gap2 = sum_along(dimension_, [&](std::size_t k) {
      const double gap = std::max(std::max(low[k] - seed_[k] - at_[k], at_[k] - (high[k] - seed_[k])), 0.0);
      return gap * gap;
    });
    return gap2 * gap_factor_ - heaviest - power_error * std::abs(heaviest);
  }
  double power(const double* position, double weight) const {
    const double gap2 = sum_along(dimension_, [&](std::size_t k) {
      const double gap = position[k] - seed_[k] - at_[k];
      return gap * gap;
    });
    return gap2 * gap_factor_ - weight - power_error * std::abs(weight);
  }

  /// Where the bisector with a seed (3) crosses the line from the cell's own seed to the point, in units of
  /// their distance; NaN or infinite if it is parallel.
  double crossing(const double* position, double weight) const {
    double square = 0, along = 0;
    for (std::size_t k = 0; k < dimension_; ++k) {
      const double q = position[k] - seed_[k];
      square += q * q;
      along += q * at_[k];
    }
    return (square + weight_ - weight) / (2 * along);
  }

  /// Whether a seed in the box could cut the cell anywhere, or touch it. (39b)
  bool may_meet(const double* low, const double* high, double heaviest) const {
    const double gap2 = sum_along(dimension_, [&](std::size_t k) {
      const double gap = std::max(std::max(low[k] - seed_[k], seed_[k] - high[k]), 0.0);
      return gap * gap;
    });
    return may_meet(gap2, heaviest);
  }
  /// The same for a box at a distance from the seed whose square is `gap2`.
  bool may_meet(double gap2, double heaviest) const {
    const double reach = radius_ * (1 + error_), far = std::max(std::sqrt(gap2), reach);
    return !(far * (far - 2 * reach) + weight_ - heaviest >
             power_error * (far * (far + 2 * reach) + std::abs(weight_) + std::abs(heaviest)) + underflow);
  }

 private:
  std::size_t dimension_;
  Point seed_{}, at_{};
  double weight_;
  double radius_;  // of a ball that contains the vertices
  double error_;   // of these, relative to the radius
  double gap_factor_;
  double limit_ = 0;
};

}  // namespace powercell::exchange
