/// \file
/// Random points of a domain. Internal.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "lib/domain/measure.hpp"

namespace powercell {

struct Sample {
  std::uint32_t region;
  Vector point;  ///< third coordinate 0 in 2D
};

/// Uniform in [0, 1), the same on every machine.
double uniform(std::mt19937_64& engine);

/// Barycentric coordinates of a uniform point of a triangle (3 corners; the last is 0) or a tetrahedron (4).
std::array<long double, 4> uniform_barycentric(std::size_t corners, std::mt19937_64& engine);

/// Points uniform in measure; the same ones for the same random seed on every machine.
std::vector<Sample> random_points(const RegionMesh& mesh, std::size_t count, std::uint64_t random_seed);

}  // namespace powercell
