/// \file
/// Elements of a mesh that overlap.
///
/// It suffices to try elements with an *open* facet, one without a neighbour on its other side. Follow a path
/// from outside the mesh to a place that two elements cover, past edges and corners. Where the count rises
/// from at most one to two it crosses a facet of an element on the far side, and not all of these have their
/// neighbour on the near side, which at most one element covers. So one of the two that cover the far side
/// has an open facet there. On a surface this holds for the triangles of each plane, with their edges.
#pragma once

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// A depth of overlap within the rounding of coordinates: 2^-50 of the largest.
double touching_depth(const RegionMesh& mesh);

/// Finds overlaps deeper than touching_depth and enters them in the report, each pair once: for each place
/// that is covered more than once at least one of its pairs.
/// \pre borders, box and measure are set
void find_overlapping_tetrahedra(RegionMesh& mesh);
void find_overlapping_triangles(RegionMesh& mesh);

}  // namespace powercell
