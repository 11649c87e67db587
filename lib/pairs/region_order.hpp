/// \file
/// Regions along a curve, so that consecutive ones share a search. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell::pairs {

/// Region numbers in Hilbert order of their centroids.
std::vector<std::uint32_t> region_order(const RegionMesh& mesh, int threads);

}  // namespace powercell::pairs
