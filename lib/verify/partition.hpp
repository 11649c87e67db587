/// \file
/// How far the sum of measures may be from the domain's. Internal.
#pragma once

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// What the domain's measure changes by, to first order, where every corner moves by 1: the sum of the
/// lengths of its gradients by the corners. It is about the boundary of a polygon or volume, and what a
/// surface bends.
long double measure_gradient(const RegionMesh& mesh);

/// Allowed relative difference (docs/mathematics.md, (17a)).
/// \param usual  what is allowed where domains are about as wide as long and seeds within them
/// \param reach  the farthest corner of the domain from a seed with a cell
double partition_tolerance(const RegionMesh& mesh, double usual, double reach);

}  // namespace powercell
