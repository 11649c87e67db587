/// \file
/// How many seeds are computed at a time, by the memory there is.
#pragma once

#include <cstdint>
#include <powercell/domain.hpp>

namespace powercell::out_of_core {

/// \param walls  whether they are kept, not only counted
/// \param most   seeds of a piece, 0 if not limited
/// \return the most seeds of a piece
/// \throw Error invalid_argument with the least memory that is enough
std::uint64_t seeds_of_piece(std::uint64_t seeds, const Domain& domain, std::uint64_t memory, bool walls,
                             std::uint64_t most);

}  // namespace powercell::out_of_core
