/// \file
/// Planes and points relative to the seed of a cell, in double precision with bounds on their errors
/// (docs/mathematics.md (80)).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "kernels/layout.h"
#include "lib/base/vectors.hpp"
#include "lib/cell/exact_cell.hpp"

namespace powercell {

using Point = Vector3<double>;  ///< in the plane the third coordinate is 0

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();
constexpr double largest_real = 1e300;
constexpr double least_product = 1e-290;  ///< smaller ones are far from relative rounding

inline double sum_of_sizes(const Point& a) {
  return std::fabs(a[0]) + std::fabs(a[1]) + std::fabs(a[2]);
}
inline Point position(const std::array<double, 4>& point) {
  return {point[0], point[1], point[2]};
}

struct HostPoint {
  Point at{};
  double error = 0;          ///< at least the distance from the true point
  bool is_verified = false;  ///< of a vertex: no seed is nearer than the cell's own
};

/// normal.y = offset with a normal of length 1.
struct HostPlane {
  Point normal{};
  double offset = 0;
  /// At least the distance of the true plane within the cell's radius, but for the rounding of the normal.
  double error = 0;
};

/// What a face of a cell, or an edge of a polygon, lies in.
struct HostFace {
  std::int32_t border;  ///< as in PieceBatch
  HostPlane plane;
};

/// The region of the domain that a cell starts as.
struct HostRegion {
  std::vector<Point> corner;
  double corner_error = 0;
  bool on_surface = false;
  const region_shape_t* shape = nullptr;  ///< of regions in a volume
};

/// Half of the points: 2 q.y <= square + weights, those nearer to the seed than to one at q.
struct Bisector {
  Point q{};
  double square = 0, weights = 0;  ///< |q|^2; by how much the seed outweighs the other
  double offset() const { return square + weights; }
  /// At least the error of 2 q.y - offset where |y| <= radius.
  double rounding(double radius) const {
    return rounding_unit * (8 * sum_of_sizes(q) * radius + 4 * (square + std::fabs(weights))) +
           2 * least_product;
  }
};

inline HostPlane plane_of(const Bisector& b) {
  // The square of a tiny q is out of range; scaling it by a power of two is exact.
  const double most = std::max({std::fabs(b.q[0]), std::fabs(b.q[1]), std::fabs(b.q[2])});
  const double scale = b.square > least_product ? 1 : std::ldexp(1.0, -std::ilogb(most));
  const Point q = scale * b.q;
  const double length = norm(q), size = length / scale, offset = 0.5 * b.offset() / size;
  return {1 / length * q, offset, rounding_unit * (2 * size + std::fabs(offset)) + least_product / size};
}

/// The vector divided by a power of two that brings its largest coordinate near 1.
inline Point scaled_to_one(const Point& a) {
  const double most = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
  return most > 0 ? std::ldexp(1.0, std::min(-std::ilogb(most), 1000)) * a : a;
}

/// The plane through y along a and b with the outward normal a x b. Where rounding leaves no normal, it is 0
/// with an infinite error, so that vertices on the plane are placed exactly.
inline HostPlane plane_of_facet(const Point& y, const Point& along_a, const Point& along_b,
                                double corner_error) {
  const Point a = scaled_to_one(along_a), b = scaled_to_one(along_b), n = cross(a, b);
  const double length = norm(n);
  if (!(length > least_product)) return {{}, 0, std::numeric_limits<double>::infinity()};
  const double scale = 1 / length;
  const Point normal = scale * n;
  return {normal, dot(normal, y), 8 * corner_error * scale * std::sqrt(dot(a, a) * dot(b, b))};
}

/// Where three planes meet; an error below 0 if they are nearly dependent, or not oriented as at a vertex of
/// a cell. The nearer `from` is, the nearer the point comes to each plane: of planes nearly dependent even a
/// point off by its error along their common line then bounds the right measure.
inline HostPoint meeting_point(const Point& from, const HostPlane& a, const HostPlane& b, const HostPlane& c,
                               double radius) {
  const Point bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal), ab = cross(a.normal, b.normal);
  const double determinant = dot(a.normal, bc), scale = 1 / determinant;
  if (!(determinant > 256 * rounding_unit)) return {{}, -1};
  const auto residual = [&](const HostPlane& plane) { return plane.offset - dot(plane.normal, from); };
  const double offsets = std::fabs(a.offset) + std::fabs(b.offset) + std::fabs(c.offset);
  return {from + scale * (residual(a) * bc + residual(b) * ca + residual(c) * ab),
          1.125 * scale * (a.error + b.error + c.error + rounding_unit * (4 * offsets + 21 * radius))};
}

/// Places the vertices of a cell: by their planes where that is near enough, else exactly.
struct HostPlacer {
  ExactCell& exact;
  double radius;
  bool is_final;  ///< no vertex will be cut off any more

  /// In units of the radius.
  static constexpr double passing_error = 1e-7, final_error = 1e-12;

  HostPoint operator()(const ExactVertex& borders, const HostPlane& a, const HostPlane& b,
                       const HostPlane& c) const {
    HostPoint p = meeting_point({}, a, b, c, radius);
    if (is_final && p.error >= 0) p = meeting_point(p.at, a, b, c, radius);
    if (p.error >= 0 && p.error <= (is_final ? final_error : passing_error) * radius) return p;
    return exactly(borders);
  }
  HostPoint exactly(const ExactVertex& borders) const {
    const ClosePoint close = exact.place(borders);
    const Point at{close[0].high, close[1].high, close[2].high};
    return {at, 4 * rounding_unit * sum_of_sizes(at)};
  }
};

}  // namespace powercell
