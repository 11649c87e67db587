/// \file
/// Random points of a domain. Internal.
#pragma once

#include <vector>

#include "lib/domain/measure.hpp"

namespace powercell {

struct Sample {
  std::uint32_t region;
  Vector point;  ///< third coordinate 0 in 2D
};

/// Points with uniform density, the same for the same random seed on every machine.
std::vector<Sample> random_points(const RegionMesh& mesh, std::size_t count, std::uint64_t random_seed);

}  // namespace powercell
