/// \file
/// Whether the rings of a polygon bound what they are to bound.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/domain/rings.hpp"

namespace powercell {

/// A vertex that lies inside an edge of another ring. Edges are numbered in the order of the rings.
struct Touch {
  std::uint32_t edge, vertex;
  friend auto operator<=>(const Touch&, const Touch&) = default;
};

/// Checks, in exact arithmetic, that
/// - no edges cross, no ring meets itself, and no two rings of a part have more than points in common;
/// - holes lie inside their outer ring and outside each other;
/// - the rings of a part touch in so few points that its inside is connected;
/// - no two parts overlap; they may touch in points and along edges.
/// O(n log n).
/// \returns where rings touch edges, in ascending order
/// \throw Error invalid_domain: which rings or parts are at fault, and where
std::vector<Touch> check_polygon(const IndexedRings& rings);

/// Makes every vertex that lies inside an edge of another ring a vertex of that ring too, so that touching
/// rings share whole edges.
/// \param touches  what check_polygon() returns for the rings
void split_touched_edges(IndexedRings& rings, std::span<const Touch> touches);

}  // namespace powercell
