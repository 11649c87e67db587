/// \file
/// Points at the same position. Internal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// For each of n points the lowest index of a point at the same position.
/// \param positions  n x d, finite
std::vector<std::uint32_t> first_at_position(std::span<const double> positions, std::size_t d);

}  // namespace powercell
