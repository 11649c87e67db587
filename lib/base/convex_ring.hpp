/// \file
/// A convex polygon as the ring of its corners, cut by a half-plane.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace powercell {

/// \tparam Point  a position, with whatever else the caller keeps of it
/// \tparam Edge   what lies behind an edge
template <class Point, class Edge>
struct RingCorner {
  Point at;
  Edge edge;  ///< from this corner to the next
};

template <class Point, class Edge>
using ConvexRing = std::vector<RingCorner<Point, Edge>>;

/// Keeps the part of a ring that is not outside a line (Sutherland and Hodgman). The caller decides the
/// sides, exactly or with rounding.
///
/// \param side   per corner: above 0 outside, 0 on the line
/// \param cut    the edge along the line
/// \param meet   meet(kept, lost, in, out): the point where the line crosses between two corners of `other`;
///               there the edge `in` ends and the edge `out` starts
/// \param other  set to the ring before the cut
/// \return how often the ring goes outside: once, unless rounding contradicts itself
template <class Point, class Edge, class Meet>
int cut_ring(ConvexRing<Point, Edge>& ring, std::span<const double> side, const Edge& cut, const Meet& meet,
             ConvexRing<Point, Edge>& other) {
  int runs = 0;
  other.swap(ring);
  ring.clear();
  for (std::size_t v = 0; v < other.size(); ++v) {
    const std::size_t next = v + 1 == other.size() ? 0 : v + 1;
    const Edge& edge = other[v].edge;
    const bool leaves = side[v] <= 0 && side[next] > 0;
    if (side[v] <= 0) ring.push_back({other[v].at, leaves && side[v] == 0 ? cut : edge});
    if (leaves && side[v] < 0) ring.push_back({meet(v, next, edge, cut), cut});
    if (side[v] > 0 && side[next] < 0) ring.push_back({meet(next, v, cut, edge), edge});
    runs += leaves;
  }
  return runs;
}

}  // namespace powercell
