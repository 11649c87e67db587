/// \file
/// Tolerance for the difference between the sum of the measures and the domain's.
#pragma once

#include "lib/domain/region_mesh.hpp"
#include "lib/verify/rounding.hpp"

namespace powercell {

/// The change of the domain's measure, to first order, if every corner moves by 1: the sum of the lengths of
/// the measure's gradients with respect to the corners. For a polygon or volume it is about the measure of
/// the boundary; for a surface it grows with its curvature.
long double measure_gradient(const RegionMesh& mesh);

/// Allowed relative difference (docs/mathematics.md, (17a)).
/// \param usual  for domains about as wide as long with the seeds inside
/// \param reach  the farthest corner of the domain from a seed with a cell
double partition_tolerance(const RegionMesh& mesh, double usual, double reach);

/// Additional tolerance (17b) for surfaces on which a bisector is nearly parallel to a triangle that it cuts:
/// each side computes the cut on its own, off by rounding over the sine of the angle. 0 for polygons and
/// volumes.
long double slanted_area(const Cells& cells, const RegionMesh& mesh, const Rounding& rounding);

}  // namespace powercell
