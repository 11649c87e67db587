/// \file
/// Random polygons on small grids, valid and invalid, in which rings touch, cross and coincide often.
#pragma once

#include <cstdint>
#include <powercell/domain.hpp>
#include <random>
#include <string>
#include <vector>

namespace powercell::test {

using Polygon = std::vector<PolygonPart>;
using Random = std::mt19937_64;

/// The number of families of polygons.
inline constexpr int families = 8;

/// A polygon of a family, with integer coordinates from -2 to 10.
Polygon random_polygon(int family, Random& random);

/// Its rings as text, to be shown with a failure.
std::string text_of(const Polygon& polygon);

/// The polygon with each point moved by `move(point)`.
template <class Move>
Polygon moved(Polygon polygon, const Move& move) {
  for (PolygonPart& part : polygon) {
    for (auto& point : part.outer) point = move(point);
    for (Ring& hole : part.holes)
      for (auto& point : hole) point = move(point);
  }
  return polygon;
}

}  // namespace powercell::test
