/// \file
/// Seeds at the same position. Internal.
#pragma once

#include <cstdint>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

namespace powercell {

/// Leaves one seed of each position in `order`, which holds all seed indices with equal positions
/// consecutive: the one of largest weight, of those the lowest index. -0.0 equals 0.0.
/// Returns the indices left out, ascending.
std::vector<std::uint32_t> drop_duplicates(const SeedsView& seeds, std::vector<std::uint32_t>& order);

}  // namespace powercell
