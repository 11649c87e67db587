#include "tests/support/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace powercell::test {

Vec operator+(const Vec& a, const Vec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec operator-(const Vec& a, const Vec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec operator*(Real s, const Vec& a) {
  return {s * a.x, s * a.y, s * a.z};
}
Real dot(const Vec& a, const Vec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vec cross(const Vec& a, const Vec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Real length(const Vec& a) {
  return std::sqrt(dot(a, a));
}

Moments& Moments::operator+=(const Moments& other) {
  measure += other.measure;
  first = first + other.first;
  second += other.second;
  return *this;
}

namespace {

/// The point where the segment from the kept `in` to the cut `out` crosses the plane. In this order for both
/// faces of an edge, so that they get the same point.
Vec crossing(const Vec& in, const Vec& out, Real excess_in, Real excess_out) {
  const Real t = excess_in / (excess_in - excess_out);
  return in + t * (out - in);
}

/// Moments of a simplex of k+1 corners with a known measure: the integral of |x|^2 is
/// measure / ((k+1)(k+2)) * (sum |v|^2 + |sum v|^2).
Moments simplex_moments(const Vec* v, int corners, Real measure) {
  Vec sum;
  Real squares = 0;
  for (int k = 0; k < corners; ++k) {
    sum = sum + v[k];
    squares += dot(v[k], v[k]);
  }
  const Real count = corners;
  return {measure, (measure / count) * sum, measure / (count * (count + 1)) * (squares + dot(sum, sum))};
}

}  // namespace

Polygon clip(const Polygon& polygon, const HalfSpace& half_space, Border border) {
  Polygon kept;
  const std::size_t n = polygon.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec& a = polygon.vertices[k];
    const Vec& b = polygon.vertices[(k + 1) % n];
    const Real ea = half_space.excess(a), eb = half_space.excess(b);
    if (ea <= 0) {
      kept.vertices.push_back(a);
      kept.border.push_back(polygon.border[k]);
      if (eb > 0) {  // leaves: the new edge starts at the crossing
        kept.vertices.push_back(crossing(a, b, ea, eb));
        kept.border.push_back(border);
      }
    } else if (eb <= 0) {  // enters: the rest of this edge starts at the crossing
      kept.vertices.push_back(crossing(b, a, eb, ea));
      kept.border.push_back(polygon.border[k]);
    }
  }
  return kept;
}

namespace {

/// One cut of a polyhedron: the sides of the vertices, the new vertices, and the edges of the cap.
class Cut {
 public:
  Cut(const Polyhedron& from, const HalfSpace& half_space) : vertices_(from.vertices) {
    excess_.reserve(vertices_.size());
    for (const Vec& v : vertices_) excess_.push_back(half_space.excess(v));
  }

  /// The kept part of a ring. Each way out of the half-space and back makes an edge of the cap.
  std::vector<std::uint32_t> clip_ring(const std::vector<std::uint32_t>& ring) {
    std::vector<std::uint32_t> kept;
    std::vector<std::uint32_t> outs, backs;  // crossings in ring order
    bool first_crossing_is_back = false;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t a = ring[k], b = ring[(k + 1) % ring.size()];
      if (excess_[a] <= 0) {
        kept.push_back(a);
        if (excess_[b] > 0) {
          outs.push_back(crossing_vertex(a, b));
          kept.push_back(outs.back());
        }
      } else if (excess_[b] <= 0) {
        if (outs.empty() && backs.empty()) first_crossing_is_back = true;
        backs.push_back(crossing_vertex(b, a));
        kept.push_back(backs.back());
      }
    }
    // The face runs out -> back along the plane, so the cap runs back -> out.
    for (std::size_t k = 0; k < outs.size(); ++k)
      cap_next_.emplace(backs[(k + (first_crossing_is_back ? 1 : 0)) % backs.size()], outs[k]);
    return kept;
  }

  /// The rings of the cap; one, unless rounding made the polyhedron non-convex.
  std::vector<std::vector<std::uint32_t>> cap_rings() {
    std::vector<std::vector<std::uint32_t>> rings;
    while (!cap_next_.empty()) {
      std::vector<std::uint32_t> ring;
      auto at = cap_next_.begin();
      while (at != cap_next_.end()) {
        ring.push_back(at->first);
        const std::uint32_t next = at->second;
        cap_next_.erase(at);
        at = cap_next_.find(next);
      }
      rings.push_back(std::move(ring));
    }
    return rings;
  }

  std::vector<Vec> take_vertices() { return std::move(vertices_); }

 private:
  std::uint32_t crossing_vertex(std::uint32_t in, std::uint32_t out) {
    const auto [entry, fresh] = made_.try_emplace({in, out}, static_cast<std::uint32_t>(vertices_.size()));
    if (fresh) vertices_.push_back(crossing(vertices_[in], vertices_[out], excess_[in], excess_[out]));
    return entry->second;
  }

  std::vector<Vec> vertices_;
  std::vector<Real> excess_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> made_;
  std::map<std::uint32_t, std::uint32_t> cap_next_;
};

/// Removes vertices that are in no ring.
void compact(Polyhedron& polyhedron) {
  std::vector<std::uint32_t> number(polyhedron.vertices.size(), UINT32_MAX);
  std::vector<Vec> used;
  for (auto& face : polyhedron.faces)
    for (std::uint32_t& v : face.ring) {
      if (number[v] == UINT32_MAX) {
        number[v] = static_cast<std::uint32_t>(used.size());
        used.push_back(polyhedron.vertices[v]);
      }
      v = number[v];
    }
  polyhedron.vertices = std::move(used);
}

}  // namespace

Polyhedron clip(Polyhedron polyhedron, const HalfSpace& half_space, Border border) {
  const auto outside = [&](const Vec& v) { return half_space.excess(v) > 0; };
  if (std::none_of(polyhedron.vertices.begin(), polyhedron.vertices.end(), outside)) return polyhedron;
  if (std::all_of(polyhedron.vertices.begin(), polyhedron.vertices.end(), outside)) return {};
  Cut cut(polyhedron, half_space);
  Polyhedron kept;
  for (const auto& face : polyhedron.faces) {
    std::vector<std::uint32_t> ring = cut.clip_ring(face.ring);
    if (!ring.empty()) kept.faces.push_back({std::move(ring), face.border});
  }
  for (auto& ring : cut.cap_rings()) kept.faces.push_back({std::move(ring), border});
  kept.vertices = cut.take_vertices();
  compact(kept);
  return kept;
}

Moments moments(const Polygon& polygon) {
  Moments sum;
  for (std::size_t k = 2; k < polygon.vertices.size(); ++k) {
    const Vec v[3] = {polygon.vertices[0], polygon.vertices[k - 1], polygon.vertices[k]};
    sum += simplex_moments(v, 3, length(cross(v[1] - v[0], v[2] - v[0])) / 2);
  }
  return sum;
}

Moments moments(const Polyhedron& polyhedron) {
  Moments sum;
  if (polyhedron.empty()) return sum;
  const Vec apex = polyhedron.vertices[polyhedron.faces[0].ring[0]];
  for (const auto& face : polyhedron.faces)
    for (std::size_t k = 2; k < face.ring.size(); ++k) {
      const Vec v[4] = {apex, polyhedron.vertices[face.ring[0]], polyhedron.vertices[face.ring[k - 1]],
                        polyhedron.vertices[face.ring[k]]};
      // Outward rings make this positive; on flat faces through the apex it is zero.
      const Real volume = dot(v[1] - apex, cross(v[2] - apex, v[3] - apex)) / 6;
      sum += simplex_moments(v, 4, volume);
    }
  return sum;
}

Real edge_length(const Polygon& polygon, std::size_t edge) {
  return length(polygon.vertices[(edge + 1) % polygon.vertices.size()] - polygon.vertices[edge]);
}

Vec twice_face_area(const Polyhedron& polyhedron, std::size_t face) {
  const auto& ring = polyhedron.faces[face].ring;
  Vec twice;
  for (std::size_t k = 2; k < ring.size(); ++k) {
    const Vec& origin = polyhedron.vertices[ring[0]];
    twice = twice + cross(polyhedron.vertices[ring[k - 1]] - origin, polyhedron.vertices[ring[k]] - origin);
  }
  return twice;
}

Real face_area(const Polyhedron& polyhedron, std::size_t face) {
  return length(twice_face_area(polyhedron, face)) / 2;
}

}  // namespace powercell::test
