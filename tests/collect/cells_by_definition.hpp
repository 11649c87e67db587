/// \file
/// Geometry of power cells made without the library: each region cut by each bisector in long double.
#pragma once

#include <powercell/domain.hpp>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

namespace powercell::test {

/// The cells of seeds in a domain; pieces of no measure are left out.
/// \param noise each coordinate is moved by up to this much, as rounding on a device would
Cells cells_by_definition(const Domain& domain, const SeedsView& seeds, double noise = 0);

/// The cells without one of their pieces, as if it had been too flat to keep.
Cells without_piece(const Cells& cells, std::uint64_t piece);

}  // namespace powercell::test
