#include "lib/domain/rings.hpp"

#include <algorithm>
#include <cmath>

#include "lib/base/mesh_arrays.hpp"
#include "lib/base/text.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell {
namespace {

constexpr std::size_t most_points = std::size_t{1} << 30;  // indices of edges of the pieces then fit 32 bits

/// Ring 0 is the outer ring, ring k hole k - 1.
const Ring& ring_of(const PolygonPart& part, std::uint32_t k) {
  return k == 0 ? part.outer : part.holes[k - 1];
}

[[noreturn]] void refuse_ring(const std::string& why) {
  throw Error(ErrorCode::invalid_domain, why);
}

/// The largest magnitude of a coordinate.
/// \throw Error invalid_domain for a coordinate that is not finite
double largest_coordinate(const Ring& ring, const std::string& where) {
  double largest = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    largest = std::max({largest, std::fabs(ring[k][0]), std::fabs(ring[k][1])});
    if (std::isfinite(ring[k][0]) && std::isfinite(ring[k][1])) continue;
    refuse_ring(where + ", point " + std::to_string(k) + ": (" + std::to_string(ring[k][0]) + ", " +
                std::to_string(ring[k][1]) + ") is not finite; correct or remove it");
  }
  return largest;
}

/// The corners of a ring in order, without repeated points and points inside straight edges.
Ring corners(const Ring& ring) {
  Ring kept;
  auto straight = [](const auto& a, const auto& b, const auto& c) {
    return strictly_between(a.data(), b.data(), c.data());
  };
  for (const auto& point : ring) {
    if (!kept.empty() && kept.back() == point) continue;
    while (kept.size() >= 2 && straight(kept[kept.size() - 2], kept.back(), point)) kept.pop_back();
    if (kept.empty() || kept.back() != point) kept.push_back(point);
  }
  while (kept.size() >= 2 && kept.back() == kept.front()) kept.pop_back();
  while (kept.size() >= 3 && straight(kept[kept.size() - 2], kept.back(), kept.front())) kept.pop_back();
  std::size_t first = 0;
  while (kept.size() - first >= 3 && straight(kept.back(), kept[first], kept[first + 1])) ++first;
  kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(first));
  return kept;
}

/// The orientation of a simple ring is the turn at its lexicographically least corner.
bool counter_clockwise(const Ring& ring) {
  const auto least = static_cast<std::size_t>(std::ranges::min_element(ring) - ring.begin());
  const std::size_t n = ring.size();
  return orient2d(ring[(least + n - 1) % n].data(), ring[least].data(), ring[(least + 1) % n].data()) > 0;
}

Ring clean(const Ring& ring, std::uint32_t part, std::uint32_t hole) {
  const std::string where = ring_name(part, hole);
  Ring kept = corners(ring);
  if (kept.size() < 3) {
    refuse_ring(where + ": a ring needs three points that are not collinear; its " +
                std::to_string(ring.size()) + " points enclose no area");
  }
  const bool outer = hole == 0;
  if (counter_clockwise(kept) != outer) std::reverse(kept.begin() + 1, kept.end());
  return kept;
}

}  // namespace

std::string place(double x, double y) {
  std::string text = "(";
  text += digits(x);
  text += ", ";
  text += digits(y);
  text += ')';
  return text;
}

std::string ring_name(std::uint32_t part, std::uint32_t hole) {
  return "part " + std::to_string(part) +
         (hole == 0 ? std::string(", outer ring") : ", hole " + std::to_string(hole - 1));
}

std::uint32_t IndexedRings::find(double x, double y) const {
  std::size_t low = 0, high = vertex_count();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const double* v = &vertices[2 * middle];
    if (v[0] < x || (v[0] == x && v[1] < y)) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  const bool found = low < vertex_count() && vertices[2 * low] == x && vertices[2 * low + 1] == y;
  return static_cast<std::uint32_t>(found ? low : vertex_count());
}

IndexedRings index_rings(std::span<const PolygonPart> parts) {
  if (parts.empty()) refuse_ring("the domain is empty: the polygon has no parts");
  if (parts.size() > most_points) refuse_ring("a polygon can have at most 2^30 parts");
  double largest = 0;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    if (parts[p].holes.size() > most_points)
      refuse_ring(ring_name(p, 0) + ": a part can have at most 2^30 holes");
    for (std::uint32_t h = 0; h <= parts[p].holes.size(); ++h) {
      largest = std::max(largest, largest_coordinate(ring_of(parts[p], h), ring_name(p, h)));
    }
  }
  if (largest > 0) check_magnitude(largest);  // else all points are 0, and the shape is refused below

  IndexedRings indexed;
  indexed.parts = static_cast<std::uint32_t>(parts.size());
  std::vector<Ring> cleaned;
  Ring points;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (std::uint32_t h = 0; h <= parts[p].holes.size(); ++h) {
      cleaned.push_back(clean(ring_of(parts[p], h), p, h));
      points.insert(points.end(), cleaned.back().begin(), cleaned.back().end());
      indexed.rings.push_back({p, h, {}});
    }
  }
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() > most_points) refuse_ring("a polygon can have at most 2^30 points");
  for (const auto& point : points)
    indexed.vertices.insert(indexed.vertices.end(), point.begin(), point.end());
  for (std::size_t r = 0; r < cleaned.size(); ++r) {
    for (const auto& [x, y] : cleaned[r]) indexed.rings[r].vertex.push_back(indexed.find(x, y));
  }
  return indexed;
}

}  // namespace powercell
