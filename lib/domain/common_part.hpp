/// \file
/// The part that two tetrahedra, or two triangles of one plane, have in common.
#pragma once

#include <array>

#include "lib/domain/measure.hpp"

namespace powercell {

/// The area or volume of a convex set, and its centroid if that is not 0.
struct CommonPart {
  long double measure = 0;
  Vector centroid{};
};

/// Of two positive tetrahedra.
CommonPart common_part(const std::array<Vector, 4>& a, const std::array<Vector, 4>& b);

/// Of a triangle and the projection of another to its plane, along the axis nearest to the normal.
CommonPart common_part(const std::array<Vector, 3>& a, const std::array<Vector, 3>& b);

}  // namespace powercell
