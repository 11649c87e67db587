/// \file
/// Measures of simplices and sums of many of them, in `long double` and from differences of coordinates, so
/// that neither a distant origin nor a million regions cost digits.
#pragma once

#include "lib/base/sums.hpp"
#include "lib/base/vectors.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell {

using Vector = Vector3<long double>;

/// A triangle or tetrahedron is flat if its least height is at most this fraction of its longest edge: four
/// units in the last place, about the height that rounding the vertices of a degenerate one can give it.
inline constexpr long double flat_ratio = 0x1p-50L;

/// Sets the measure, and the bounding box of the vertices that regions use.
/// \throw Error invalid_domain if coordinates or measure are out of range
void finish(RegionMesh& mesh, const CompensatedSum<long double>& measure);

}  // namespace powercell
