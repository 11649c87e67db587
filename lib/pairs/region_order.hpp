/// \file
/// Regions in an order in which groups are compact. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/domain/region_mesh.hpp"

namespace powercell::pairs {

/// Region numbers so that each `fan`^l consecutive ones, counted from the first, are near each other: ranges
/// are halved across their longest axis, at multiples of the largest group that is smaller than they are.
/// Does not depend on `threads`.
std::vector<std::uint32_t> region_order(const RegionMesh& mesh, std::size_t fan, int threads);

}  // namespace powercell::pairs
