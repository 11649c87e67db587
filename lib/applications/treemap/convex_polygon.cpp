#include "lib/applications/treemap/convex_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "lib/base/random.hpp"
#include "lib/base/text.hpp"

namespace powercell::treemap_detail {
namespace {

// A corner is straight if the sine of its angle is below this: outlines are rounded to decimals.
constexpr double straight = 1e-12;

// Limits within which moments, fourth powers of lengths, stay in the range of doubles.
constexpr double largest_coordinate = 1e60, least_area = 1e-120;

// Largest relative change of the area of an outline by rounding its corners.
constexpr double largest_area_error = 1e-6;

double cross(double ax, double ay, double bx, double by) {
  return ax * by - ay * bx;
}

std::string at(double x, double y) {
  return "(" + digits(x) + ", " + digits(y) + ")";
}

std::vector<double> without_repeated(const Ring& ring) {
  std::vector<double> points;
  for (const auto& p : ring) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]))
      throw Error(ErrorCode::invalid_domain, "the outline has a corner that is not finite");
    if (std::max(std::fabs(p[0]), std::fabs(p[1])) > largest_coordinate)
      throw Error(ErrorCode::invalid_domain,
                  "the outline has a corner farther than 1e60 from the origin; scale it");
    const std::size_t n = points.size();
    if (n > 0 && points[n - 2] == p[0] && points[n - 1] == p[1]) continue;
    points.insert(points.end(), p.begin(), p.end());
  }
  while (points.size() > 2 && points[0] == points[points.size() - 2] && points[1] == points.back())
    points.resize(points.size() - 2);
  return points;
}

/// The sine of the angle by which the boundary turns at corner k; -2 if it turns back.
double turn(const std::vector<double>& p, std::size_t k) {
  const std::size_t n = p.size() / 2, before = (k + n - 1) % n, after = (k + 1) % n;
  const double ax = p[2 * k] - p[2 * before], ay = p[2 * k + 1] - p[2 * before + 1];
  const double bx = p[2 * after] - p[2 * k], by = p[2 * after + 1] - p[2 * k + 1];
  const double sine = cross(ax, ay, bx, by) / (std::hypot(ax, ay) * std::hypot(bx, by));
  if (std::fabs(sine) <= straight && ax * bx + ay * by < 0) return -2;
  return sine;
}

/// \param corners  at least three
/// \throw Error invalid_domain if the area is too small or too uncertain
void require_certain_area(const std::vector<double>& corners) {
  const std::size_t n = corners.size() / 2;
  double perimeter = 0, largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = (k + 1) % n;
    perimeter += std::hypot(corners[2 * next] - corners[2 * k], corners[2 * next + 1] - corners[2 * k + 1]);
    largest = std::max({largest, std::fabs(corners[2 * k]), std::fabs(corners[2 * k + 1])});
  }
  const double area = moments(corners).area;
  if (!(area >= least_area))
    throw Error(ErrorCode::invalid_domain, "the outline has an area below 1e-120; scale it");
  if (!(std::numeric_limits<double>::epsilon() * largest * perimeter <= largest_area_error * area))
    throw Error(ErrorCode::invalid_domain,
                "the outline is so thin, or so far from the origin, that rounding its corners changes its "
                "area by more "
                "than a millionth; move it to the origin, or choose another shape");
}

}  // namespace

PolygonMoments moments(std::span<const double> vertices) {
  PolygonMoments m;
  const std::size_t n = vertices.size() / 2;
  if (n < 3) return m;
  const double x0 = vertices[0], y0 = vertices[1];
  for (std::size_t v = 1; v + 1 < n; ++v) {
    const double ax = vertices[2 * v] - x0, ay = vertices[2 * v + 1] - y0;
    const double bx = vertices[2 * v + 2] - x0, by = vertices[2 * v + 3] - y0;
    const double area = 0.5 * cross(ax, ay, bx, by);
    m.area += area;
    m.x += area * (ax + bx) / 3;
    m.y += area * (ay + by) / 3;
    m.xx += area * (ax * ax + ax * bx + bx * bx) / 6;
    m.yy += area * (ay * ay + ay * by + by * by) / 6;
    m.xy += area * (2 * ax * ay + 2 * bx * by + ax * by + bx * ay) / 12;
  }
  if (m.area == 0) return m;
  m.x /= m.area;
  m.y /= m.area;
  m.xx -= m.area * m.x * m.x;
  m.yy -= m.area * m.y * m.y;
  m.xy -= m.area * m.x * m.y;
  m.x += x0;
  m.y += y0;
  return m;
}

double aspect(const PolygonMoments& m) {
  // For a thin cell the lesser principal moment is lost in a difference, but the product of both is bounded:
  // divided by the fourth power of the area, it lies between those of ellipses and triangles for convex
  // cells.
  constexpr double least = 1 / (16 * std::numbers::pi * std::numbers::pi), most = 1.0 / 108;
  const double unit = m.area * m.area;
  const double xx = m.xx / unit, yy = m.yy / unit, xy = m.xy / unit;
  const double greater = 0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy);
  return greater / std::sqrt(std::clamp(xx * yy - xy * xy, least, most));
}

std::vector<double> convex_outline(const Ring& ring) {
  std::vector<double> points = without_repeated(ring);
  if (points.size() < 6) throw Error(ErrorCode::invalid_domain, "the outline has fewer than three corners");
  if (moments(points).area < 0) {
    std::vector<double> turned;
    for (std::size_t k = points.size() / 2; k-- > 0;)
      turned.insert(turned.end(), {points[2 * k], points[2 * k + 1]});
    points = turned;
  }
  std::vector<double> corners;
  double round = 0;
  for (std::size_t k = 0; k < points.size() / 2; ++k) {
    const double sine = turn(points, k);
    if (sine < -straight)
      throw Error(ErrorCode::invalid_domain, "the outline is not convex at " +
                                                 at(points[2 * k], points[2 * k + 1]) +
                                                 "; use its convex hull or another shape");
    if (sine <= straight) continue;
    corners.insert(corners.end(), {points[2 * k], points[2 * k + 1]});
  }
  const std::size_t n = corners.size() / 2;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t a = (k + n - 1) % n, b = (k + 1) % n;
    const double ax = corners[2 * k] - corners[2 * a], ay = corners[2 * k + 1] - corners[2 * a + 1];
    const double bx = corners[2 * b] - corners[2 * k], by = corners[2 * b + 1] - corners[2 * k + 1];
    round += std::atan2(cross(ax, ay, bx, by), ax * bx + ay * by);
  }
  if (n < 3 || !(moments(corners).area > 0))
    throw Error(ErrorCode::invalid_domain, "the outline has no area");
  if (round > 3 * std::numbers::pi)
    throw Error(ErrorCode::invalid_domain, "the outline crosses itself: it goes around more than once");
  require_certain_area(corners);
  return corners;
}

GroupFrame::GroupFrame(const PolygonMoments& of) : x(of.x), y(of.y), size(std::sqrt(of.area)) {}

Columns GroupFrame::inside(std::span<const double> vertices) const {
  Columns local;
  local.resize(vertices.size() / 2);
  for (std::size_t v = 0; v < local.size(); ++v) {
    local.x[v] = (vertices[2 * v] - x) / size;
    local.y[v] = (vertices[2 * v + 1] - y) / size;
  }
  return local;
}

bool contains(const Columns& polygon, double x, double y) {
  const std::size_t n = polygon.size();
  for (std::size_t v = 0; v < n; ++v) {
    const std::size_t next = v + 1 == n ? 0 : v + 1;
    const double ex = polygon.x[next] - polygon.x[v], ey = polygon.y[next] - polygon.y[v];
    if (!(cross(ex, ey, x - polygon.x[v], y - polygon.y[v]) > 1e-12 * std::hypot(ex, ey))) return false;
  }
  return true;
}

Columns spread_points(const Columns& polygon, std::size_t n, std::uint64_t random_seed) {
  std::vector<double> corners;
  for (std::size_t v = 0; v < polygon.size(); ++v)
    corners.insert(corners.end(), {polygon.x[v], polygon.y[v]});
  // Of a box along the principal axes, a polygon covers at least some tenths, however thin it is.
  const PolygonMoments m = moments(corners);
  const double angle = 0.5 * std::atan2(2 * m.xy, m.xx - m.yy), c = std::cos(angle), s = std::sin(angle);
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  for (std::size_t v = 0; v < polygon.size(); ++v) {
    const double along[2] = {c * polygon.x[v] + s * polygon.y[v], c * polygon.y[v] - s * polygon.x[v]};
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], along[k]);
      high[k] = std::max(high[k], along[k]);
    }
  }
  // Reciprocals of the plastic number and its square, the two-dimensional analogue of the golden ratio.
  constexpr double step[2] = {0.7548776662466927, 0.5698402909980532};
  double u = unit_from_bits(mixed_bits(random_seed)),
         v = unit_from_bits(mixed_bits(random_seed ^ 0x5851f42d4c957f2du));
  Columns points;
  for (std::size_t tries = 0; points.size() < n; ++tries) {
    if (tries > 100 * (n + 10)) {  // a sliver as wide as rounding errors: places the points along its middle
      const double t = unit_from_bits(mixed_bits(random_seed + tries));
      points.x.push_back(c * (low[0] + t * (high[0] - low[0])) - s * (low[1] + high[1]) / 2);
      points.y.push_back(s * (low[0] + t * (high[0] - low[0])) + c * (low[1] + high[1]) / 2);
      continue;
    }
    u += step[0];
    v += step[1];
    u -= std::floor(u);
    v -= std::floor(v);
    const double a = low[0] + u * (high[0] - low[0]), b = low[1] + v * (high[1] - low[1]);
    const double x = c * a - s * b, y = s * a + c * b;
    if (!contains(polygon, x, y)) continue;
    points.x.push_back(x);
    points.y.push_back(y);
  }
  return points;
}

}  // namespace powercell::treemap_detail
