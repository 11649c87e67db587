/// \file
/// Convex parts that a region is split into during the search for candidates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace powercell::pairs {

template <int D>
using Point = std::array<double, D>;

template <int D>
double squared_distance(const Point<D>& a, const Point<D>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < D; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

inline constexpr std::size_t most_corners = 8;

enum class PartShape : unsigned char {
  polygon,      ///< corners in order around it
  tetrahedron,  ///< any orientation
  box,          ///< bit k of v is set if corner v has the high coordinate on axis k
};

/// The convex hull of at most `most_corners` corners, relative to an origin that the caller knows.
template <int D>
struct Part {
  std::array<Point<D>, most_corners> corner;
  std::size_t corners = 0;
  PartShape shape = PartShape::polygon;

  Point<D> centroid() const {
    Point<D> sum{};
    for (std::size_t v = 0; v < corners; ++v)
      for (std::size_t k = 0; k < D; ++k) sum[k] += corner[v][k];
    for (double& x : sum) x /= static_cast<double>(corners);
    return sum;
  }
  /// The largest distance of a corner from the centroid.
  double radius() const {
    const Point<D> middle = centroid();
    double most = 0;
    for (std::size_t v = 0; v < corners; ++v) most = std::max(most, squared_distance<D>(corner[v], middle));
    return std::sqrt(most);
  }
};

namespace detail {

template <int D>
Point<D> middle(const Point<D>& a, const Point<D>& b) {
  Point<D> m;
  for (std::size_t k = 0; k < D; ++k) m[k] = 0.5 * (a[k] + b[k]);
  return m;
}

/// Cuts a polygon of four or more corners by a chord, which makes no new corners and so no rounding.
template <int D>
std::pair<Part<D>, Part<D>> split_by_chord(const Part<D>& part) {
  std::size_t from = 0;
  const std::size_t half = part.corners / 2;
  if (part.corners == 4 && squared_distance<D>(part.corner[1], part.corner[3]) <
                               squared_distance<D>(part.corner[0], part.corner[2]))
    from = 1;
  Part<D> a, b;
  for (std::size_t k = 0; k <= half; ++k) a.corner[a.corners++] = part.corner[(from + k) % part.corners];
  for (std::size_t k = half; k <= part.corners; ++k)
    b.corner[b.corners++] = part.corner[(from + k) % part.corners];
  return {a, b};
}

/// Cuts a triangle or tetrahedron in the middle of its longest edge, which also shortens long thin ones.
template <int D>
std::pair<Part<D>, Part<D>> split_longest_edge(const Part<D>& part) {
  std::size_t a = 0, b = 1;
  double longest = -1;
  for (std::size_t v = 0; v < part.corners; ++v)
    for (std::size_t w = v + 1; w < part.corners; ++w) {
      const double length = squared_distance<D>(part.corner[v], part.corner[w]);
      if (length > longest) longest = length, a = v, b = w;
    }
  std::pair<Part<D>, Part<D>> halves{part, part};
  halves.first.corner[b] = halves.second.corner[a] = middle<D>(part.corner[a], part.corner[b]);
  return halves;
}

template <int D>
std::pair<Part<D>, Part<D>> split_box(const Part<D>& part) {
  std::size_t axis = 0;
  double longest = -1;
  for (std::size_t k = 0; k < D; ++k) {
    const double length = part.corner[part.corners - 1][k] - part.corner[0][k];
    if (length > longest) longest = length, axis = k;
  }
  const std::size_t bit = std::size_t{1} << axis;
  std::pair<Part<D>, Part<D>> halves{part, part};
  for (std::size_t v = 0; v < part.corners; ++v)
    if ((v & bit) == 0)
      halves.first.corner[v | bit] = halves.second.corner[v] =
          middle<D>(part.corner[v], part.corner[v | bit]);
  return halves;
}

}  // namespace detail

/// Two parts whose union is `part` up to the rounding of new corners: at most one unit roundoff of the
/// largest coordinate per split.
template <int D>
std::pair<Part<D>, Part<D>> split(const Part<D>& part) {
  if (part.shape == PartShape::box) return detail::split_box(part);
  if (part.shape == PartShape::polygon && part.corners > 3) return detail::split_by_chord(part);
  return detail::split_longest_edge(part);
}

}  // namespace powercell::pairs
