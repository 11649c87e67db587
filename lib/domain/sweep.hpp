/// \file
/// Triangulation of a polygon by a plane sweep, with exact decisions only.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/domain/rings.hpp"

namespace powercell {

/// Triangles, 3 vertices each and counter-clockwise, of the part with these rings. Rings may touch in
/// vertices, and vertices may lie straight on; edges must not cross. O(n log n).
/// Empty if edges cross (by less than the validity check noticed).
/// After Hertel and Mehlhorn, "Fast triangulation of simple polygons", 1983.
std::vector<std::uint32_t> sweep_triangulate(const IndexedRings& vertices,
                                             std::span<const IndexedRing> rings);

}  // namespace powercell
