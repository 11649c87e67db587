#include "lib/domain/triangle_pairs.hpp"

#include <algorithm>
#include <tuple>

#include "lib/base/box_tree.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell {
namespace {

using CornerPointers = std::array<const double*, 3>;

/// A point without its coordinate along an axis.
std::array<double, 2> without(const double* x, std::size_t axis) {
  return {x[(axis + 1) % 3], x[(axis + 2) % 3]};
}

int turn(const double* a, const double* b, const double* c, std::size_t axis) {
  return orient2d(without(a, axis).data(), without(b, axis).data(), without(c, axis).data());
}

/// An axis along which a triangle projects to one.
std::size_t visible_along(const CornerPointers& t) {
  std::size_t axis = 0;
  while (axis < 2 && turn(t[0], t[1], t[2], axis) == 0) ++axis;
  return axis;
}

/// Whether a point in the plane of a triangle lies in the triangle or on its edges.
bool contains(const CornerPointers& t, const double* x, std::size_t axis) {
  bool left = false, right = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = turn(t[k], t[(k + 1) % 3], x, axis);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

/// Whether two segments in a plane meet, but for one that lies in the line of the other.
bool segments_cross(const double* a, const double* b, const double* c, const double* d, std::size_t axis) {
  return turn(a, b, c, axis) * turn(a, b, d, axis) <= 0 && turn(c, d, a, axis) * turn(c, d, b, axis) < 0;
}

/// Whether a segment meets a triangle, edges and ends included.
bool meets(const double* p, const double* q, const CornerPointers& t) {
  const int at_p = orient3d(t[0], t[1], t[2], p), at_q = orient3d(t[0], t[1], t[2], q);
  if (at_p * at_q > 0) return false;
  const std::size_t axis = visible_along(t);
  if (at_p == 0 && contains(t, p, axis)) return true;
  if (at_q == 0 && contains(t, q, axis)) return true;
  if (at_p == 0 && at_q == 0) {
    for (std::size_t k = 0; k < 3; ++k)
      if (segments_cross(t[k], t[(k + 1) % 3], p, q, axis) ||
          segments_cross(p, q, t[k], t[(k + 1) % 3], axis))
        return true;
    return false;
  }
  if (at_p == 0 || at_q == 0) return false;
  bool left = false, right = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const int side = orient3d(p, q, t[k], t[(k + 1) % 3]);
    left = left || side > 0;
    right = right || side < 0;
  }
  return !(left && right);
}

class Pairs {
 public:
  Pairs(std::span<const double> vertices, const std::vector<Corners>& triangles)
      : vertices_(vertices), triangles_(triangles) {}

  const double* at(std::uint32_t v) const { return &vertices_[3 * std::size_t{v}]; }
  CornerPointers triangle(std::uint32_t row) const {
    const Corners& c = triangles_[row];
    return {at(c[0]), at(c[1]), at(c[2])};
  }

  bool improper(std::uint32_t i, std::uint32_t j) const {
    const Corners &a = triangles_[i], &b = triangles_[j];
    const auto has = [](const Corners& c, std::uint32_t v) {
      return std::find(c.begin(), c.end(), v) != c.end();
    };
    const auto shared = std::count_if(a.begin(), a.end(), [&](std::uint32_t v) { return has(b, v); });
    if (shared == 3) return true;
    if (shared == 2) return overlap_at_edge(a, b);
    // Of triangles with one common corner that share more, an opposite edge meets the other triangle.
    const auto edges_meet = [&](const Corners& c, const Corners& other, std::uint32_t row) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = c[k], to = c[(k + 1) % 3];
        if (!has(other, from) && !has(other, to) && meets(at(from), at(to), triangle(row))) return true;
      }
      return false;
    };
    return edges_meet(a, b, j) || edges_meet(b, a, i);
  }

 private:
  /// Whether two triangles with a common edge lie in a plane, on the same side of it.
  bool overlap_at_edge(const Corners& a, const Corners& b) const {
    std::size_t k = 0;  // corner k of a is not in b
    while (std::find(b.begin(), b.end(), a[k]) != b.end()) ++k;
    const std::uint32_t from = a[(k + 1) % 3], to = a[(k + 2) % 3];
    const std::uint32_t other =
        *std::find_if(b.begin(), b.end(), [&](std::uint32_t v) { return v != from && v != to; });
    const CornerPointers t{at(a[k]), at(from), at(to)};
    if (orient3d(t[0], t[1], t[2], at(other)) != 0) return false;
    const std::size_t axis = visible_along(t);
    return turn(at(from), at(to), at(a[k]), axis) == turn(at(from), at(to), at(other), axis);
  }

  std::span<const double> vertices_;
  const std::vector<Corners>& triangles_;
};

}  // namespace

std::optional<TrianglePair> find_improper_pair(std::span<const double> vertices,
                                               const std::vector<Corners>& triangles) {
  const Pairs pairs(vertices, triangles);
  std::vector<Box> boxes(triangles.size());
  for (std::uint32_t t = 0; t < boxes.size(); ++t)
    for (const double* x : pairs.triangle(t)) boxes[t].add(x);
  const BoxTree tree(boxes);
  for (std::uint32_t t = 0; t < boxes.size(); ++t) {
    std::uint32_t first = t;
    tree.for_each_meeting(boxes[t], [&](std::uint32_t s) {
      if (s < first && pairs.improper(s, t)) first = s;
    });
    if (first == t) continue;
    TrianglePair pair{first, t, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = std::max(boxes[first].low[k], boxes[t].low[k]),
                   high = std::min(boxes[first].high[k], boxes[t].high[k]);
      pair.place[k] = low + (high - low) / 2;
    }
    return pair;
  }
  return {};
}

}  // namespace powercell
