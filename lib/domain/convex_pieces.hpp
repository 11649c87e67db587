/// \file
/// Cuts a part of a polygon into convex pieces that tile it exactly.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/domain/rings.hpp"

namespace powercell {

/// Most vertices of a piece: the smallest clip kernels have room for about 32, and cutting adds some.
inline constexpr std::size_t piece_capacity = 24;

/// Convex polygons, counter-clockwise; piece k is vertex[offset[k] .. offset[k+1]).
struct Pieces {
  std::vector<std::uint32_t> offset{0};
  std::vector<std::uint32_t> vertex;
};

/// Appends the pieces of the part with these rings. All their vertices are vertices of the rings, and a
/// vertex on an edge shared by two pieces is a vertex of both. A convex part of at most `piece_capacity`
/// vertices is one piece.
void append_convex_pieces(const IndexedRings& vertices, std::span<const IndexedRing> rings, Pieces& pieces);

}  // namespace powercell
