/// \file
/// Triangles of a surface that have more in common than corners and edges.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace powercell {

using Corners = std::array<std::uint32_t, 3>;

struct TrianglePair {
  std::uint32_t first, second;  ///< rows of the triangles, ascending
  std::array<double, 3> place;  ///< the middle of the common part of their boxes
};

/// A pair of triangles that share a point which is not a corner of both nor on an edge of both: that cross,
/// overlap in a plane, or touch otherwise. Exact. Of several pairs the one with the lowest rows.
/// \param vertices  nv x 3, distinct positions
/// \param triangles  without corners in line
std::optional<TrianglePair> find_improper_pair(std::span<const double> vertices,
                                               const std::vector<Corners>& triangles);

}  // namespace powercell
