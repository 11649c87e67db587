/// \file
/// Power cells computed without the library: each region is cut by each bisector in long double.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

namespace powercell::test {

/// The cells of seeds in a domain, without pieces of measure 0.
/// \param noise  each coordinate is moved by up to this much, like rounding on a device
Cells cells_by_definition(const Domain& domain, const SeedsView& seeds, double noise = 0);

/// The cells without one of their pieces, as if it had been too flat to be kept.
Cells without_piece(const Cells& cells, std::uint64_t piece);

}  // namespace powercell::test
