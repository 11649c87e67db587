/// \file
/// Eight doubles as one vector of the compiler, which does not vectorise such short loops by itself.
/// Internal.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

namespace powercell {

constexpr std::size_t lane_count = 8;

/// One coordinate of eight boxes or points.
using Lanes = std::array<double, lane_count>;

namespace lanes {

using Vector [[gnu::vector_size(lane_count * sizeof(double))]] = double;

[[gnu::always_inline]] inline void load(const void* from, Vector& to) {
  std::memcpy(&to, from, sizeof to);
}
[[gnu::always_inline]] inline void store(const Vector& from, void* to) {
  std::memcpy(to, &from, sizeof from);
}

}  // namespace lanes
}  // namespace powercell
