/// \file
/// How far the sum of measures may be from the domain's. Internal.
#pragma once

#include "lib/domain/region_mesh.hpp"
#include "lib/verify/rounding.hpp"

namespace powercell {

/// What the domain's measure changes by, to first order, where every corner moves by 1: the sum of the
/// lengths of its gradients by the corners. It is about the boundary of a polygon or volume, and what a
/// surface bends.
long double measure_gradient(const RegionMesh& mesh);

/// Allowed relative difference (docs/mathematics.md, (17a)).
/// \param usual  what is allowed where domains are about as wide as long and seeds within them
/// \param reach  the farthest corner of the domain from a seed with a cell
double partition_tolerance(const RegionMesh& mesh, double usual, double reach);

/// What the cells of a surface may measure too much or too little together, beside that, where a bisector is
/// all but parallel to a triangle that it cuts: either side has its own place of the cut, off by rounding
/// over the sine of the angle. 0 for polygons and volumes, which lie in the space of their seeds.
long double slanted_area(const Cells& cells, const RegionMesh& mesh, const Rounding& rounding);

}  // namespace powercell
