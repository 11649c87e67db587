/// \file
/// Eight doubles as one vector of the compiler, which does not vectorise such short loops by itself.
/// Internal.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "lib/base/compiler.hpp"

namespace powercell {

constexpr std::size_t lane_count = 8;

/// One coordinate of eight boxes or points.
using Lanes = std::array<double, lane_count>;

namespace lanes {

using Vector POWERCELL_VECTOR(lane_count * sizeof(double)) = double;

POWERCELL_ALWAYS_INLINE void load(const void* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
POWERCELL_ALWAYS_INLINE void store(const Vector& from, void* to) {
  std::memcpy(to, &from, sizeof from);
}

}  // namespace lanes
}  // namespace powercell
