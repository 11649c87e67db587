/// \file
/// How many seeds are computed at a time, by the memory there is. Internal.
#pragma once

#include <cstdint>

namespace powercell::out_of_core {

/// \param many_regions  whether the domain has more than one region
/// \return the most seeds of a piece \throw Error invalid_argument with the least memory that is enough
std::uint64_t seeds_of_piece(std::uint64_t seeds, int dimension, bool many_regions, std::uint64_t memory,
                             std::uint64_t most);

}  // namespace powercell::out_of_core
