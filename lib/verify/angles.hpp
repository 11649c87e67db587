/// \file
/// Corners and facets of regions, and the angles at which planes meet them. Internal.
#pragma once

#include <vector>

#include "lib/verify/laws.hpp"

namespace powercell {

using Corners = std::vector<Vector>;

Corners corners_of(const RegionMesh& mesh, std::size_t region);

/// The facets of a region, given its corners: edges of polygons and triangles, faces of tetrahedra and boxes.
std::vector<Corners> facets_of(const RegionMesh& mesh, const Corners& corner);

/// A normal, of any length, of the plane through three or more corners.
Vector normal_of(const Corners& corner);

/// Sine of the angle between two directions, or between a direction and a plane; vectors may have any length.
long double sine_between(const Vector& a, const Vector& b);
long double sine_to_plane(const Vector& direction, const Vector& normal);

}  // namespace powercell
