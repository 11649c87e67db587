/// \file
/// Triangulation of one part of a polygon, proven to tile it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "lib/domain/geos.hpp"
#include "lib/domain/rings.hpp"

namespace powercell {

inline constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

/// Triangles and what lies across their edges. Half-edge 3 t + c goes from corner c of triangle t to
/// the next; its twin is the half-edge the other way, or `no_twin` on a ring.
struct Triangulation {
  std::vector<std::uint32_t> corner;  ///< 3 a triangle, counter-clockwise
  std::vector<std::uint32_t> twin;    ///< 3 a triangle
};

/// The constrained Delaunay triangulation of the part with the rings [first, last).
/// The result is checked exactly: all triangles are positive, and their edges cancel but for the rings,
/// so they cover each point as often as the rings wind around it: once inside and never outside.
/// \throw Error internal if no such triangulation was found
Triangulation triangulate(geos::Context& geos, const IndexedRings& rings, std::size_t first,
                          std::size_t last);

}  // namespace powercell
