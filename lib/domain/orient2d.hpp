/// \file
/// Exact sign of the area of a triangle in the plane.
#pragma once

namespace powercell {

/// +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if collinear: the sign for the doubles as
/// given, decided exactly (unless products under- or overflow).
int orient2d(const double* a, const double* b, const double* c);

/// True if b lies on the open segment from a to c, exactly.
bool strictly_between(const double* a, const double* b, const double* c);

}  // namespace powercell
