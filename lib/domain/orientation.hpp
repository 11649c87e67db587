/// \file
/// Exact signs of the area of a triangle and the volume of a tetrahedron.
#pragma once

#include <cstdint>
#include <span>

namespace powercell {

/// +1 if a, b, c turn counter-clockwise, -1 if clockwise, 0 if collinear: the exact sign for the given
/// doubles.
/// \pre products of coordinates do not overflow
int orient2d(const double* a, const double* b, const double* c);

/// The sign of det(b - a, c - a, d - a): exact for the given doubles.
int orient3d(const double* a, const double* b, const double* c, const double* d);

/// True if b lies on the open segment from a to c, exactly.
bool strictly_between(const double* a, const double* b, const double* c);

/// The sign of the determinant of the edges from the first corner, for any doubles. Slow: in rational
/// numbers.
/// \param positions  rows of d coordinates
/// \param corners  d+1 indices of rows; d is 2 or 3
int exact_orientation(std::span<const double> positions, std::span<const std::uint32_t> corners);

}  // namespace powercell
