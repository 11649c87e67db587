/// \file
/// The tolerance for the difference between the sum of measures and the domain's measure. Internal.
#pragma once

#include "lib/domain/region_mesh.hpp"
#include "lib/verify/rounding.hpp"

namespace powercell {

/// The change of the domain's measure, to first order, if every corner moves by 1: the sum of the lengths of
/// its gradients with respect to the corners. That is about the size of the boundary of a polygon or volume,
/// and the total curvature of a surface.
long double measure_gradient(const RegionMesh& mesh);

/// The allowed relative difference (docs/mathematics.md, (17a)).
/// \param usual  the value for domains about as wide as long, with the seeds inside
/// \param reach  the largest distance between a corner of the domain and a seed with a cell
double partition_tolerance(const RegionMesh& mesh, double usual, double reach);

/// A further tolerance for the sum of measures on a surface, where bisectors are nearly parallel to triangles
/// that they cut: each side computes the cut by itself, with an error of rounding over the sine of the angle.
/// 0 for polygons and volumes, which fill the space of their seeds.
long double slanted_area(const Cells& cells, const RegionMesh& mesh, const Rounding& rounding);

}  // namespace powercell
