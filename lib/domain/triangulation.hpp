/// \file
/// Triangulation of one part of a polygon, proven to tile it.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lib/domain/rings.hpp"

namespace powercell {

inline constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

/// Triangles and what lies across their edges. Half-edge 3 t + c goes from corner c of triangle t to
/// the next; its twin is the half-edge the other way, or `no_twin` on a ring.
struct Triangulation {
  std::vector<std::uint32_t> corner;  ///< 3 a triangle, counter-clockwise
  std::vector<std::uint32_t> twin;    ///< 3 a triangle
};

/// The constrained Delaunay triangulation of the part with these rings, up to near-ties.
/// What comes out is checked exactly: all triangles are positive, and their edges cancel but for the
/// rings, so they cover each point as often as the rings wind around it: once inside, never outside.
/// \throw Error invalid_domain if edges of the rings cross
Triangulation triangulate(const IndexedRings& vertices, std::span<const IndexedRing> rings);

/// Flips diagonals until the triangulation is Delaunay, constrained by the rings, up to near-ties and a
/// bound on the work.
void make_delaunay(const IndexedRings& vertices, Triangulation& mesh);

}  // namespace powercell
