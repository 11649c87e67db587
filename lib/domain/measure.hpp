/// \file
/// Measures of simplices and sums of many of them, in `long double` from differences of coordinates,
/// so that neither a far origin nor a million regions cost digits.
#pragma once

#include "lib/base/sums.hpp"
#include "lib/base/vectors.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell {

using Vector = Vector3<long double>;

/// A triangle or tetrahedron is flat when its least height is at most this fraction of its longest
/// edge: four units in the last place, about what rounding its vertices can make of a true zero.
inline constexpr long double flat_ratio = 0x1p-50L;

/// Sets the bounding box from the vertices that regions use, and checks that coordinates and measure are of
/// a size to compute with. \throw Error invalid_domain
void finish(RegionMesh& mesh, const CompensatedSum<long double>& measure);

}  // namespace powercell
