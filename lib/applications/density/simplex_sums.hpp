/// \file
/// Simplices with a density at their corners, and integrals over one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "lib/applications/density/simplex.hpp"
#include "lib/applications/density/simplex_rule.hpp"

namespace powercell {

/// A point relative to the origin of an integral, with the density there.
struct Corner {
  Point at{};
  double value = 0;
};

template <int N>
using Simplex = std::array<Corner, N + 1>;

inline double measure(const Simplex<1>& s) {
  return measure_of_segment(s[0].at, s[1].at);
}
inline double measure(const Simplex<2>& s) {
  return measure_of_triangle(s[0].at, s[1].at, s[2].at);
}
inline double measure(const Simplex<3>& s) {
  return measure_of_tetrahedron(s[0].at, s[1].at, s[2].at, s[3].at);
}

template <std::size_t Corners>
SimplexEdge longest_edge_of(const std::array<Corner, Corners>& simplex) {
  return longest_edge(Corners, [&](std::size_t c) -> const Point& { return simplex[c].at; });
}

/// A simplex relative to its middle.
template <int N>
struct Local {
  Point middle{};
  Point reach{};  ///< length scale by which first moments are compared with masses
  std::array<Point, N + 1> corner;
  explicit Local(const Simplex<N>& simplex) {
    for (const Corner& c : simplex)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += c.at[k] / (N + 1);
    for (std::size_t c = 0; c <= N; ++c) corner[c] = simplex[c].at - middle;
    for (std::size_t k = 0; k < 3; ++k)
      reach[k] = corner[N][k] * 2 / (N + 3);  // to the first point of rule 1
  }
  /// Position relative to the middle.
  Point place(const Barycentric& point) const {
    Point y{};
    for (std::size_t c = 0; c <= N; ++c)
      for (std::size_t k = 0; k < 3; ++k) y[k] += point[c] * corner[c][k];
    return y;
  }
};

/// Integrals over a simplex scaled to measure 1, relative to its middle, or contributions to them: of the
/// density rho, of rho |y|² and of rho times each barycentric coordinate.
template <int N>
struct Sums {
  double mass = 0, second = 0;
  std::array<double, N + 1> at_corner{};

  /// \param place  position of the point relative to the middle
  void add(double value, const Barycentric& point, const Point& place) {
    mass += value;
    for (std::size_t c = 0; c <= N; ++c) at_corner[c] += value * point[c];
    second += value * dot(place, place);
  }
  void add(double weight, const Sums& part) {
    mass += weight * part.mass;
    for (std::size_t c = 0; c <= N; ++c) at_corner[c] += weight * part.at_corner[c];
    second += weight * part.second;
  }
  Point first(const Local<N>& local) const {
    Point sum{};
    for (std::size_t c = 0; c <= N; ++c)
      for (std::size_t k = 0; k < 3; ++k) sum[k] += at_corner[c] * local.corner[c][k];
    return sum;
  }
};

/// The difference of two rules, in the unit of the mass: in the mass, or in the first moment divided by
/// Local::reach, whichever is larger.
template <int N>
double difference(const Sums<N>& a, const Sums<N>& b, const Local<N>& local) {
  const Point moved = a.first(local) - b.first(local);
  return std::max(std::abs(a.mass - b.mass), std::sqrt(dot(moved, moved) / dot(local.reach, local.reach)));
}

/// Detects jumps and kinks near the boundary of a simplex, which the interior points of the rules miss.
/// Compares values with the linear function of the same moments, (32a): at the boundary a polynomial of the
/// rules' degree is up to some twenty times farther from it than at the points.
template <int N>
class LinearFit {
 public:
  /// \param value  the density at the first points of the rules
  LinearFit(const Sums<N>& found, std::span<const double> value) {
    const SimplexRules& rules = simplex_rules(N);
    for (std::size_t c = 0; c <= N; ++c)
      at_corner_[c] = (N + 1) * ((N + 2) * found.at_corner[c] - found.mass);
    for (std::size_t q = 0; q < value.size(); ++q)
      deviation_ = std::max(deviation_, std::abs(value[q] - at(rules.point[q])));
  }
  /// How far a value at a point of the boundary lies outside what a polynomial can explain; below 0 if
  /// inside.
  double misfit(const Barycentric& point, double value) const {
    constexpr double growth = 20;  // of the deviation, from the points to the boundary
    return std::abs(value - at(point)) - growth * deviation_;
  }
  double misfit_of_corners(const Simplex<N>& simplex) const {
    double most = 0;
    for (std::size_t c = 0; c <= N; ++c) {
      Barycentric corner{};
      corner[c] = 1;
      most = std::max(most, misfit(corner, simplex[c].value));
    }
    return most;
  }

 private:
  double at(const Barycentric& point) const {
    double value = 0;
    for (std::size_t c = 0; c <= N; ++c) value += point[c] * at_corner_[c];
    return value;
  }

  std::array<double, N + 1> at_corner_;
  double deviation_ = 0;  // largest at the points of the rules
};

}  // namespace powercell
