/// \file
/// Regions of the domain by their corners, and the angles at which planes meet them. Internal.
#pragma once

#include <vector>

#include "lib/verify/laws.hpp"

namespace powercell {

using Corners = std::vector<Vector>;

Corners corners_of(const RegionMesh& mesh, std::size_t region);

/// The facets of a region with these corners: edges of polygons and triangles, faces of tetrahedra and boxes.
std::vector<Corners> facets_of(const RegionMesh& mesh, const Corners& corner);

/// Of the plane of three corners or more, of any length.
Vector normal_of(const Corners& corner);

/// Sines of the angles of two directions, and of a direction and a plane; vectors are of any lengths.
long double sine_between(const Vector& a, const Vector& b);
long double sine_to_plane(const Vector& direction, const Vector& normal);

}  // namespace powercell
