#include "apps/io/maps/projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/error.hpp>

#include "apps/io/printable.hpp"
#include "apps/io/read/polygons.hpp"

namespace powercell::io {
namespace {

/// Of the traced polygons, over their area; a fiftieth of it is for cells that are small and at the boundary.
constexpr double allowed_area_error = 1e-6;
constexpr double relative_tolerance = allowed_area_error / 50;
constexpr int deepest_bisection = 24;
constexpr double pi = 3.14159265358979323846;

MapPoint middle_of(MapPoint a, MapPoint b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
}

double distance(MapPoint a, MapPoint b) {
  return std::hypot(a[0] - b[0], a[1] - b[1]);
}

/// Distance of a point from the line through a and b.
double distance_from_line(MapPoint p, MapPoint a, MapPoint b) {
  const double length = distance(a, b);
  if (length == 0) return distance(p, a);
  return std::abs((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])) / length;
}

double signed_area(const Ring& ring) {
  double twice = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const MapPoint &o = ring[0], &a = ring[k], &b = ring[(k + 1) % ring.size()];
    twice += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return twice / 2;
}

template <class Function>
void for_each_ring(const std::vector<PolygonPart>& parts, const Function& function) {
  for (const PolygonPart& part : parts) {
    function(part.outer, 1);
    for (const Ring& hole : part.holes) function(hole, -1);
  }
}

template <class Function>
std::vector<PolygonPart> map_rings(const std::vector<PolygonPart>& parts, const Function& function) {
  std::vector<PolygonPart> mapped;
  for (const PolygonPart& part : parts) {
    PolygonPart& to = mapped.emplace_back();
    to.outer = function(part.outer);
    for (const Ring& hole : part.holes) to.holes.push_back(function(hole));
  }
  return mapped;
}

/// Area between the equator and a parallel on a unit sphere of the same shape, per radian of longitude, times
/// 2 (Snyder 1987, (3-12)).
double authalic(double e, double latitude) {
  const double s = std::sin(latitude);
  if (e == 0) return 2 * s;
  return (1 - e * e) * (s / (1 - e * e * s * s) + std::atanh(e * s) / e);
}

double squared_eccentricity(const Ellipsoid& ellipsoid) {
  const double f = ellipsoid.inverse_flattening == 0 ? 0 : 1 / ellipsoid.inverse_flattening;
  return f * (2 - f);
}

double longitude_near(double longitude, double middle) {
  if (std::abs(longitude - middle) <= 180) return longitude;
  return longitude - 360 * std::round((longitude - middle) / 360);
}

/// The middle of the box of longitudes and latitudes, where longitudes are unwrapped about the mean
/// direction.
MapPoint middle_of(const std::vector<MapPoint>& degrees) {
  double x = 0, y = 0, low = 360, high = -360;
  for (const MapPoint& p : degrees) {
    x += std::cos(p[0] * pi / 180) * std::cos(p[1] * pi / 180);
    y += std::sin(p[0] * pi / 180) * std::cos(p[1] * pi / 180);
    low = std::min(low, p[0]);
    high = std::max(high, p[0]);
  }
  const double mean = longitude_near(std::atan2(y, x) * 180 / pi, (low + high) / 2);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 4> box = {infinity, -infinity, infinity, -infinity};
  for (const MapPoint& p : degrees) {
    const double longitude = longitude_near(p[0], mean);
    box = {std::min(box[0], longitude), std::max(box[1], longitude), std::min(box[2], p[1]),
           std::max(box[3], p[1])};
  }
  // Two decimals, so that people can write the projection down.
  const auto rounded = [](double a, double b) { return std::round((a + b) * 50) / 100; };
  return {rounded(box[0], box[1]), rounded(box[2], box[3])};
}

[[noreturn]] void fail_around() {
  throw Error(
      ErrorCode::invalid_domain,
      "its polygons reach around a pole or the globe, where longitudes do not bound them; cut them, or give "
      "them in a projection (such as EPSG:6931 or EPSG:6932 about the poles)");
}

void require_degrees(const Crs& crs, const std::vector<PolygonPart>& parts) {
  for_each_ring(parts, [&](const Ring& ring, int) {
    for (const MapPoint& p : ring)
      if (!(std::abs(p[0]) <= 540 && std::abs(p[1]) <= 90))
        throw Error(
            ErrorCode::invalid_domain,
            fmt::format("the point ({}, {}) is no longitude and latitude in degrees, as {} has them; name "
                        "the system that its coordinates are in with --crs",
                        p[0], p[1], readable(crs.name)));
  });
}

}  // namespace

double areal_scale(const Crs& crs, const PointMap& to_degrees, MapPoint point) {
  constexpr double step = 1e-3;  // degrees
  const MapPoint p = to_degrees.forward(point);
  const double latitude = p[1] * pi / 180, e2 = squared_eccentricity(crs.ellipsoid);
  if (!(std::abs(p[1]) < 89.9)) return std::nan("");
  const MapPoint east = to_degrees.inverse({p[0] + step, p[1]}),
                 west = to_degrees.inverse({p[0] - step, p[1]}),
                 north = to_degrees.inverse({p[0], p[1] + step}),
                 south = to_degrees.inverse({p[0], p[1] - step});
  const double plane =
      std::abs((east[0] - west[0]) * (north[1] - south[1]) - (east[1] - west[1]) * (north[0] - south[0]));
  // Radii of curvature along the meridian and across it.
  const double w = 1 - e2 * std::sin(latitude) * std::sin(latitude);
  const double ground = crs.ellipsoid.a * crs.ellipsoid.a * (1 - e2) / (w * w) * std::cos(latitude);
  return plane / (ground * std::pow(2 * step * pi / 180, 2)) * crs.metres * crs.metres;
}

double ring_area(const Ellipsoid& ellipsoid, const Ring& degrees) {
  // Green's theorem. Along an edge longitude and latitude are linear; Gauss's rule with 5 points on pieces of
  // at most 2 degrees leaves errors near rounding.
  constexpr std::array<double, 5> at = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                        0.9061798459386640};
  constexpr std::array<double, 5> weight = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                            0.4786286704993665, 0.2369268850561891};
  const double e = std::sqrt(squared_eccentricity(ellipsoid));
  double sum = 0;
  for (std::size_t k = 0; k < degrees.size(); ++k) {
    const MapPoint &a = degrees[k], &b = degrees[(k + 1) % degrees.size()];
    const int pieces = 1 + static_cast<int>(std::abs(b[1] - a[1]) / 2);
    for (int piece = 0; piece < pieces; ++piece)
      for (std::size_t g = 0; g < at.size(); ++g) {
        const double t = (piece + (1 + at[g]) / 2) / pieces;
        sum -= weight[g] / 2 / pieces * (b[0] - a[0]) * pi / 180 *
               authalic(e, (a[1] + t * (b[1] - a[1])) * pi / 180);
      }
  }
  return ellipsoid.a * ellipsoid.a / 2 * sum;
}

MapPlane::MapPlane(const Crs& crs, std::vector<PolygonPart> parts)
    : crs_(crs), degrees_(map_to_degrees(crs)), map_parts_(std::move(parts)) {
  if (crs.geographic) require_degrees(crs, map_parts_);
  std::vector<MapPoint> degrees;
  for_each_ring(map_parts_, [&](const Ring& ring, int) {
    for (const MapPoint& p : ring) degrees.push_back(degrees_->forward(p));
  });
  middle_ = middle_of(degrees);
  projection_ = equal_area(crs.ellipsoid, middle_);
  bool moved = false;
  map_parts_ = map_rings(map_parts_, [&](const Ring& ring) {
    Ring whole;
    for (const MapPoint& point : ring) whole.push_back(unwrapped(point));
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t next = (k + 1) % ring.size();
      if (std::abs((whole[next][0] - whole[k][0]) - (ring[next][0] - ring[k][0])) > 180) fail_around();
    }
    moved = moved || whole != ring;
    return whole;
  });
  if (moved) {  // parts that were cut at 180 degrees meet again
    std::vector<std::vector<PolygonPart>> groups;
    for (const PolygonPart& part : map_parts_) groups.push_back({part});
    map_parts_ = unite(groups, "across 180 degrees of longitude");
  }

  double area = 0, perimeter = 0, farthest = 0;
  for_each_ring(map_parts_, [&](const Ring& ring, int sign) {
    const auto pieces = std::max<std::size_t>(1, 2000 / ring.size());
    Ring rough;
    for (std::size_t k = 0; k < ring.size(); ++k)
      for (std::size_t piece = 0; piece < pieces; ++piece) {
        const MapPoint &a = ring[k], &b = ring[(k + 1) % ring.size()];
        const double t = static_cast<double>(piece) / static_cast<double>(pieces);
        rough.push_back(to_plane({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}));
        farthest = std::max(farthest, distance(rough.back(), {0, 0}));
        if (rough.size() > 1) perimeter += distance(rough.back(), rough[rough.size() - 2]);
      }
    area += sign * std::abs(signed_area(rough));
  });
  tolerance_ = relative_tolerance * std::abs(area) / perimeter;
  const double half = std::min(1.0, farthest / (2 * crs.ellipsoid.a));  // sine of half the angle
  distortion_ = 1 / std::sqrt(std::max(1 - half * half, 1e-12)) - 1;
  parts_ = map_rings(map_parts_, [&](const Ring& ring) { return traced(ring, tolerance_); });
  if (crs.geographic) check_area(map_parts_);
}

MapPoint MapPlane::unwrapped(MapPoint map) const {
  if (crs_.geographic) map[0] = longitude_near(map[0], middle_[0]);
  return map;
}

MapPoint MapPlane::to_plane(MapPoint map) const {
  MapPoint degrees = degrees_->forward(map);
  degrees[0] = longitude_near(degrees[0], middle_[0]);
  return projection_.map->forward(degrees);
}

MapPoint MapPlane::to_map(MapPoint plane) const {
  return degrees_->inverse(projection_.map->inverse(plane));
}

MapPoint MapPlane::rounded(MapPoint map) const {
  const double digits = crs_.geographic ? 1e10 : 1e5;
  for (double& coordinate : map) coordinate = std::round(coordinate * digits) / digits;
  return map;
}

/// How far the straight edge from a to b on the map is from the segment in the plane.
double MapPlane::deviation(MapPoint a, MapPoint b, MapPoint plane_a, MapPoint plane_b) const {
  const MapPoint m = middle_of(a, b);
  double largest = 0;
  for (const MapPoint& p : {middle_of(a, m), m, middle_of(m, b)})
    largest = std::max(largest, distance_from_line(to_plane(p), plane_a, plane_b));
  return largest;
}

Ring MapPlane::traced(const Ring& ring, double tolerance) const {
  Ring path;
  const auto edge = [&](const auto& self, MapPoint a, MapPoint b, MapPoint plane_a, MapPoint plane_b,
                        int depth) -> void {
    if (depth == 0 || deviation(a, b, plane_a, plane_b) <= tolerance) {
      path.push_back(plane_b);
      return;
    }
    const MapPoint m = middle_of(a, b), plane_m = to_plane(m);
    self(self, a, m, plane_a, plane_m, depth - 1);
    self(self, m, b, plane_m, plane_b, depth - 1);
  };
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const MapPoint a = ring[k], b = ring[(k + 1) % ring.size()];
    edge(edge, a, b, to_plane(a), to_plane(b), deepest_bisection);
  }
  return path;
}

void MapPlane::trace_to_map(MapPoint from, MapPoint to, std::vector<MapPoint>& path) const {
  const auto segment = [&](const auto& self, MapPoint a, MapPoint b, MapPoint map_a, MapPoint map_b,
                           int depth) -> void {
    if (depth == 0 || deviation(map_a, map_b, a, b) <= tolerance_) {
      path.push_back(rounded(map_b));
      return;
    }
    const MapPoint m = middle_of(a, b), map_m = to_map(m);
    self(self, a, m, map_a, map_m, depth - 1);
    self(self, m, b, map_m, map_b, depth - 1);
  };
  segment(segment, from, to, to_map(from), to_map(to), deepest_bisection);
}

void MapPlane::check_area(const std::vector<PolygonPart>& parts) const {
  double exact = 0, traced = 0;
  for_each_ring(
      parts, [&](const Ring& ring, int sign) { exact += sign * std::abs(ring_area(crs_.ellipsoid, ring)); });
  for_each_ring(parts_, [&](const Ring& ring, int sign) { traced += sign * std::abs(signed_area(ring)); });
  if (!(std::abs(traced - exact) <= allowed_area_error * exact)) fail_around();
}

}  // namespace powercell::io
