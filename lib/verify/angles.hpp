/// \file
/// Corners and facets of the domain's regions, and angles between directions and planes.
#pragma once

#include <vector>

#include "lib/verify/laws.hpp"

namespace powercell {

using Corners = std::vector<Vector>;

Corners corners_of(const RegionMesh& mesh, std::size_t region);

/// The facets of the region with these corners: edges of polygons and triangles, faces of tetrahedra and
/// boxes.
std::vector<Corners> facets_of(const RegionMesh& mesh, const Corners& corner);

/// Normal, of any length, of the plane of three or more corners.
Vector normal_of(const Corners& corner);

/// Sines of the angle between two directions and of that between a direction and a plane, for vectors of any
/// length.
long double sine_between(const Vector& a, const Vector& b);
long double sine_to_plane(const Vector& direction, const Vector& normal);

}  // namespace powercell
