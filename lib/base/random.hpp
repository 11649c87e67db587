/// \file
/// Random numbers that are the same on every machine.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

namespace powercell {

/// Uniform in [0, 1), from the upper 53 of 64 random bits.
inline double unit_from_bits(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}
inline double uniform(std::mt19937_64& engine) {
  return unit_from_bits(engine());
}

/// One step of splitmix64: consecutive integers become independent random bits.
inline std::uint64_t mixed_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Barycentric coordinates of a uniform point of a triangle (`corners` 3; the last coordinate is 0) or a
/// tetrahedron (4): the lengths into which corners - 1 uniform numbers divide [0, 1].
inline std::array<long double, 4> uniform_barycentric(std::size_t corners, std::mt19937_64& engine) {
  std::array<double, 5> cut{0, 1, 1, 1, 1};
  for (std::size_t k = 1; k < corners; ++k) cut[k] = uniform(engine);
  std::sort(cut.begin(), cut.end());
  std::array<long double, 4> share;
  for (std::size_t k = 0; k < share.size(); ++k) share[k] = static_cast<long double>(cut[k + 1]) - cut[k];
  return share;
}

}  // namespace powercell
