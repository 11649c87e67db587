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

}  // namespace powercell::test
