/// \file
/// Copies of single points. Internal.
#pragma once

#include <cstddef>

namespace powercell {

/// Copies the coordinates of a point in dimension d, 2 or 3. Of a length that is not known to the compiler,
/// std::copy_n makes a call of memmove, which takes longer than the copy: loops over all seeds have many.
inline void copy_point(const double* from, std::size_t d, double* to) {
  to[0] = from[0];
  to[1] = from[1];
  if (d == 3) to[2] = from[2];
}

}  // namespace powercell
