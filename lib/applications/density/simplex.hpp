/// \file
/// Measures and edges of simplices.
#pragma once

#include <cmath>
#include <cstddef>

#include "lib/applications/density/piece.hpp"

namespace powercell {

inline double measure_of_segment(const Point& a, const Point& b) {
  const Point e = b - a;
  return std::sqrt(dot(e, e));
}
inline double measure_of_triangle(const Point& a, const Point& b, const Point& c) {
  const Point normal = cross(b - a, c - a);
  return std::hypot(normal[0], normal[1], normal[2]) / 2;  // squares of areas may overflow
}
/// Signed: where rounding turns tetrahedra of a fan inside out, the excess cancels.
inline double measure_of_tetrahedron(const Point& a, const Point& b, const Point& c, const Point& d) {
  return dot(b - a, cross(c - a, d - a)) / 6;
}

/// The edge between two corners of a simplex.
struct SimplexEdge {
  std::size_t from = 0, to = 1;
  double square = -1;  ///< squared length
};

/// The longest edge, of equally long ones the first.
/// \param at  at(c) is the position of corner c
template <class At>
SimplexEdge longest_edge(std::size_t corners, const At& at) {
  SimplexEdge longest;
  for (std::size_t a = 0; a < corners; ++a)
    for (std::size_t b = a + 1; b < corners; ++b) {
      const Point e = at(a) - at(b);
      if (dot(e, e) > longest.square) longest = {a, b, dot(e, e)};
    }
  return longest;
}

}  // namespace powercell
