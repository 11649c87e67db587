/// \file
/// Regions with the fields that the search for pairs reads: corners, shapes and dimensions.
#pragma once

#include <string>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::test {

/// \param elements  the corners of each region; tetrahedra are oriented positively
RegionMesh regions(RegionShape shape, int dimension, const std::vector<double>& vertices,
                   const std::vector<std::vector<std::uint32_t>>& elements);

RegionMesh square_of_triangles(int per_axis);  ///< [0,1]^2, two triangles a grid cell
RegionMesh disc_of_polygons(int corners);      ///< a regular polygon cut by chords into three pieces
RegionMesh surface_regions(const Mesh& mesh);
RegionMesh volume_regions(const Mesh& mesh);
RegionMesh boxes(int per_axis);                               ///< [0,1]^3 cut into boxes
RegionMesh triangle_soup(std::size_t count, Random& random);  ///< of all sizes and thinness, in [0,1]^3
RegionMesh cube_surface(int per_axis);  ///< of [0.2, 0.8]^3, 12 triangles for per_axis = 1

/// Applies x -> s x + by to all corners.
void transform(RegionMesh& mesh, double s, double by);

}  // namespace powercell::test
