#include "apps/treemap_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <powercell/shapes.hpp>
#include <string_view>

#include "apps/io/read/domain.hpp"
#include "apps/io/read/text.hpp"

namespace powercell::app {
namespace {

std::optional<Ring> rectangle(const std::string& spec) {
  const std::size_t colon = spec.find(':');
  if (colon == std::string::npos) return std::nullopt;
  double width = 0, height = 0;
  const std::string_view text = spec;
  if (io::parse_number(text.substr(0, colon), width) != io::Parsed::ok ||
      io::parse_number(text.substr(colon + 1), height) != io::Parsed::ok)
    return std::nullopt;
  if (!(width > 0) || !(height > 0))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--shape {}: width and height must be above 0", spec));
  return Ring{{0, 0}, {width, 0}, {width, height}, {0, height}};
}

std::optional<Ring> circle(const std::string& spec) {
  if (spec == "circle") return disk(256);
  constexpr std::string_view prefix = "circle:";
  if (spec.compare(0, prefix.size(), prefix) != 0) return std::nullopt;
  int corners = 0;
  const char* end = spec.data() + spec.size();
  const auto [stop, error] = std::from_chars(spec.data() + prefix.size(), end, corners);
  if (error != std::errc() || stop != end || corners < 3 || corners > 10000)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("--shape {}: a circle has 3 to 10000 corners", spec));
  return disk(corners);
}

using Point = std::array<double, 2>;

double cross(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Counter-clockwise (Andrew's monotone chain).
Ring convex_hull(Ring points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Ring hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Point& point : points) {
      while (hull.size() >= first + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

double area(const Ring& ring) {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) twice += cross(ring[0], ring[k], ring[k + 1]);
  return std::abs(twice) / 2;
}

// The hull of an outline that only the rounding of its coordinates makes concave; any other outline as it is.
Ring without_rounding(const Ring& ring, std::vector<std::string>& notes) {
  constexpr double most = 1e-4;  // of the size, far below what a picture shows
  Ring hull = convex_hull(ring);
  const double whole = area(hull), more = whole / area(ring) - 1;
  if (hull.size() < 3 || !(more > 1e-12) || more > most) return ring;
  double depth = 0;
  for (const Point& point : ring) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Point &a = hull[k], &b = hull[(k + 1) % hull.size()];
      nearest = std::min(nearest, cross(a, b, point) / std::hypot(b[0] - a[0], b[1] - a[1]));
    }
    depth = std::max(depth, nearest);
  }
  if (depth > most * std::sqrt(whole)) return ring;
  notes.push_back(fmt::format(
      "the shape is concave by up to {:.2g}; its convex hull is used, whose area is greater by {:.2g} %",
      depth, 100 * more));
  return hull;
}

}  // namespace

Ring treemap_shape(const std::string& spec, std::vector<std::string>& notes) {
  if (const auto ring = rectangle(spec)) return *ring;
  if (const auto ring = circle(spec)) return *ring;
  if (spec == "hexagon") return disk(6);
  const io::LoadedDomain loaded = io::read_domain(spec);
  if (loaded.domain.kind() != DomainKind::polygon)
    throw Error(ErrorCode::invalid_domain, fmt::format("{}: the shape of a treemap must be a polygon", spec));
  if (loaded.domain.is_periodic())
    throw Error(
        ErrorCode::invalid_domain,
        fmt::format("{}: the shape of a treemap cannot be periodic; give a file with the polygon", spec));
  if (loaded.parts.size() != 1 || !loaded.parts.front().holes.empty())
    throw Error(
        ErrorCode::invalid_domain,
        fmt::format("{}: {} parts, {} holes; a treemap needs one convex polygon", spec, loaded.parts.size(),
                    loaded.parts.empty() ? 0 : loaded.parts.front().holes.size()));
  return without_rounding(loaded.parts.front().outer, notes);
}

}  // namespace powercell::app
