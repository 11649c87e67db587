/// \file
/// Flat regions in space, given by the edges around them, in convex polygons.
#pragma once

#include <span>
#include <vector>

#include "lib/base/vectors.hpp"
#include "lib/solid/flat_parts.hpp"

namespace powercell::solid {

/// An edge of a flat region between two vertices, with the region on its left.
struct DirectedEdge {
  std::uint32_t from, to;
};

/// Convex polygons that tile a region as append_convex_parts() does, by the numbers of their vertices. Edges
/// in opposite directions cancel.
/// \param edges  as many from each vertex as to it, in any order
/// \param normal of the plane, to the side from which left is left
Polygons tile(std::vector<DirectedEdge> edges, std::span<const Vector3<double>> position,
              const Vector3<double>& normal);

}  // namespace powercell::solid
