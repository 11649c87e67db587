/// \file
/// Points by their coordinates: copies, and points at the same position.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// For each of n points the lowest index of a point at the same position.
/// \param positions  n x d, finite
std::vector<std::uint32_t> first_at_position(std::span<const double> positions, std::size_t d);

/// Copies the coordinates of a point in dimension d, 2 or 3. Of a length that is not known to the compiler,
/// std::copy_n makes a call of memmove, which takes longer than the copy: loops over all seeds have many.
inline void copy_point(const double* from, std::size_t d, double* to) {
  to[0] = from[0];
  to[1] = from[1];
  if (d == 3) to[2] = from[2];
}

}  // namespace powercell
