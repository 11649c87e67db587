/// \file
/// Triangulation of one part of a polygon: a plane sweep, then Delaunay flips, then a proof that the
/// triangles tile the part.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lib/domain/rings.hpp"

namespace powercell {

inline constexpr std::uint32_t no_twin = std::numeric_limits<std::uint32_t>::max();

/// Triangles and their neighbours. Half-edge 3 t + c goes from corner c of triangle t to the next corner; its
/// twin is the half-edge in the other direction, or `no_twin` on a ring.
struct Triangulation {
  std::vector<std::uint32_t> corner;  ///< 3 a triangle, counter-clockwise
  std::vector<std::uint32_t> twin;    ///< 3 a triangle
};

/// The constrained Delaunay triangulation of the part with these rings, up to near-ties.
/// The result is checked exactly: all triangles are positive, and their edges other than those of the rings
/// cancel, so they cover each point as often as the rings wind around it: once inside, never outside.
/// \throw Error invalid_domain if edges of the rings cross
Triangulation triangulate(const IndexedRings& vertices, std::span<const IndexedRing> rings);

/// Triangles, 3 vertices each and counter-clockwise, of the part with these rings, by a plane sweep in exact
/// arithmetic: O(n log n). Rings may touch in vertices and may have straight vertices, but edges must not
/// cross; if they do the result may be empty.
/// After Hertel and Mehlhorn, "Fast triangulation of simple polygons", 1983.
std::vector<std::uint32_t> sweep_triangulate(const IndexedRings& vertices,
                                             std::span<const IndexedRing> rings);

/// Flips diagonals until the triangulation is Delaunay, constrained by the rings, up to near-ties and a limit
/// on the number of flips.
void make_delaunay(const IndexedRings& vertices, Triangulation& mesh);

}  // namespace powercell
