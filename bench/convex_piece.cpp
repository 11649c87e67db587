#include "bench/convex_piece.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace powercell::bench {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

/// The point of the segment where the excess is 0.
Vec3 crossing(const Vec3& a, double excess_a, const Vec3& b, double excess_b) {
  return a + excess_a / (excess_a - excess_b) * (b - a);
}

/// Computes how far each point lies beyond the bisector. \return the number of those that do
template <class Points>
std::size_t find_excess(const Points& points, const Vec3& q, double offset, std::vector<double>& excess) {
  excess.resize(points.size());
  std::size_t outside = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    excess[k] = dot(q, points[k].at) - offset;
    outside += excess[k] > 0;
  }
  return outside;
}

template <class Points>
double largest_square_of(const Points& points) {
  double largest = 0;
  for (const auto& p : points) largest = std::max(largest, dot(p.at, p.at));
  return largest;
}

}  // namespace

void PolygonPiece::start(const Vec3* corners) {
  ring_.clear();
  for (std::uint32_t k = 0; k < 3; ++k) ring_.push_back({corners[k], k});
}

Cut PolygonPiece::cut(const Vec3& q, double offset, std::uint32_t border) {
  const std::size_t outside = find_excess(ring_, q, offset, excess_);
  if (outside == 0) return Cut::untouched;
  if (outside == ring_.size()) return Cut::nothing_left;
  kept_.clear();
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    const std::size_t next = k + 1 < ring_.size() ? k + 1 : 0;
    const bool in = excess_[k] <= 0, next_in = excess_[next] <= 0;
    if (in) kept_.push_back(ring_[k]);
    if (in == next_in) continue;
    const Vec3 at = crossing(ring_[k].at, excess_[k], ring_[next].at, excess_[next]);
    kept_.push_back({at, in ? border : ring_[k].border});
  }
  std::swap(ring_, kept_);
  return Cut::smaller;
}

double PolygonPiece::largest_square() const {
  return largest_square_of(ring_);
}

double PolygonPiece::measure() const {
  Vec3 twice{};
  for (std::size_t k = 2; k < ring_.size(); ++k)
    twice = twice + cross(ring_[k - 1].at - ring_[0].at, ring_[k].at - ring_[0].at);
  return 0.5 * norm(twice);
}

void PolygonPiece::borders(std::vector<std::uint32_t>& list) const {
  for (const Corner& corner : ring_) list.push_back(corner.border);
}

void PolyhedronPiece::start(const Vec3* corners) {
  const bool positive =
      dot(cross(corners[1] - corners[0], corners[2] - corners[0]), corners[3] - corners[0]) > 0;
  // Facet k is opposite corner k. For positive corners (v, u, s, t), facet s is to the left of the edge v u.
  static constexpr std::uint32_t to[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  static constexpr std::uint32_t left[4][3] = {{2, 3, 1}, {3, 2, 0}, {1, 3, 0}, {2, 1, 0}};
  static constexpr std::uint32_t other[4][3] = {{3, 1, 2}, {2, 0, 3}, {3, 0, 1}, {1, 0, 2}};
  vertices_.resize(4);
  for (std::uint32_t v = 0; v < 4; ++v) {
    vertices_[v].at = corners[v];
    for (std::uint32_t e = 0; e < 3; ++e) {
      vertices_[v].to[e] = to[v][e];
      vertices_[v].left[e] = positive ? left[v][e] : other[v][e];
    }
  }
  border_ = {0, 1, 2, 3};
}

Cut PolyhedronPiece::cut(const Vec3& q, double offset, std::uint32_t border) {
  const std::size_t outside = find_excess(vertices_, q, offset, excess_);
  if (outside == 0) return Cut::untouched;
  const std::size_t count = vertices_.size();
  if (outside == count) return Cut::nothing_left;
  const auto face = static_cast<std::uint32_t>(border_.size());
  border_.push_back(border);
  right_.clear();
  for (std::uint32_t v = 0; v < count; ++v) {
    if (excess_[v] > 0) continue;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t u = vertices_[v].to[e];
      if (!(excess_[u] > 0)) continue;
      const Vertex& far = vertices_[u];
      const std::size_t back = far.to[0] == v ? 0 : far.to[1] == v ? 1 : 2;
      const std::uint32_t right = far.left[back];
      // Edges of the new vertex: back to v, along the face to the left, and along the new face.
      const Vertex made{crossing(vertices_[v].at, excess_[v], far.at, excess_[u]),
                        {v, none, none},
                        {right, vertices_[v].left[e], face}};
      vertices_[v].to[e] = static_cast<std::uint32_t>(vertices_.size());
      vertices_.push_back(made);
      right_.push_back(right);
    }
  }
  link_new_vertices(count, face);
  drop_cut_vertices(count);
  return Cut::smaller;
}

/// Joins the two new vertices of each face that was cut.
void PolyhedronPiece::link_new_vertices(std::size_t first, std::uint32_t face) {
  of_face_.assign(face, none);
  for (std::size_t w = first; w < vertices_.size(); ++w) {
    std::uint32_t& slot = of_face_[vertices_[w].left[1]];
    if (slot != none) throw std::runtime_error("rounding makes a cut leave a face twice");
    slot = static_cast<std::uint32_t>(w);
  }
  for (std::size_t w = first; w < vertices_.size(); ++w) {
    const std::uint32_t partner = of_face_[right_[w - first]];
    if (partner == none) throw std::runtime_error("rounding makes a cut leave a face without entering it");
    vertices_[w].to[2] = partner;
    vertices_[partner].to[1] = static_cast<std::uint32_t>(w);
  }
}

void PolyhedronPiece::drop_cut_vertices(std::size_t old_count) {
  renumbered_.resize(vertices_.size());
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (v < old_count && excess_[v] > 0) continue;
    renumbered_[v] = kept;
    vertices_[kept++] = vertices_[v];
  }
  vertices_.resize(kept);
  for (Vertex& v : vertices_)
    for (std::uint32_t& to : v.to) to = renumbered_[to];
}

double PolyhedronPiece::largest_square() const {
  return largest_square_of(vertices_);
}

/// Sums the tetrahedra from the first vertex to the triangles of each face, which are fans around a vertex.
double PolyhedronPiece::measure() {
  of_face_.assign(border_.size(), none);
  for (std::uint32_t v = 0; v < vertices_.size(); ++v)
    for (const std::uint32_t face : vertices_[v].left)
      if (of_face_[face] == none) of_face_[face] = v;
  const Vec3 apex = vertices_[0].at;
  const auto next = [&](std::uint32_t v, std::uint32_t face) {
    const Vertex& at = vertices_[v];
    return at.left[0] == face ? at.to[0] : at.left[1] == face ? at.to[1] : at.to[2];
  };
  double six_times = 0;
  for (std::uint32_t face = 0; face < of_face_.size(); ++face) {
    const std::uint32_t first = of_face_[face];
    if (first == none || first == 0) continue;  // faces at the apex contribute nothing
    const Vec3 a = vertices_[first].at - apex;
    std::uint32_t v = next(first, face);
    Vec3 b = vertices_[v].at - apex, twice{};
    for (v = next(v, face); v != first; v = next(v, face)) {
      const Vec3 c = vertices_[v].at - apex;
      twice = twice + cross(b - a, c - a);
      b = c;
    }
    six_times += dot(a, twice);
  }
  return six_times / 6;
}

void PolyhedronPiece::borders(std::vector<std::uint32_t>& list) const {
  // Each remaining face is to the left of an edge at each of its vertices; repetitions do no harm.
  for (const Vertex& v : vertices_)
    for (const std::uint32_t face : v.left) list.push_back(border_[face]);
}

}  // namespace powercell::bench
