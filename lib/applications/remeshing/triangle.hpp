/// \file
/// Measures of a triangle.
#pragma once

#include "lib/applications/remeshing/vec.hpp"

namespace powercell::remeshing {

/// The point of triangle abc nearest to x.
Vec nearest_in_triangle(Vec x, Vec a, Vec b, Vec c);
/// 6/sqrt(3) area / (half perimeter x longest edge), (64): 1 if equilateral.
double triangle_quality(Vec a, Vec b, Vec c);
/// The cosine of the least angle.
double largest_cosine(Vec a, Vec b, Vec c);
/// At most 1 if no angle is below 40 degrees and the quality is at least `good`; larger for worse shapes.
double misshape(Vec a, Vec b, Vec c, double good);

}  // namespace powercell::remeshing
