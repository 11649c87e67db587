/// \file
/// Seeds at one position. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// Per seed the one of lowest index at its position. \param positions  n x d, finite
std::vector<std::uint32_t> first_at_position(std::span<const double> positions, std::size_t d);

}  // namespace powercell
