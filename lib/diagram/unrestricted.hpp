/// \file
/// Decides which unrestricted cells lie inside the domain.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <vector>

#include "lib/diagram/setup.hpp"

namespace powercell {

/// Marks unrestricted cells outside the domain as hidden in `measures`. They do not meet the boundary, so one
/// point of a cell decides (docs/mathematics.md, "Cells inside the domain").
/// \return the ranks of cells for which this is unclear: too thin, or in overlapping regions
std::vector<std::uint32_t> classify_unrestricted_cells(const DiagramSetup& setup, const SeedSet& seeds,
                                                       const Pairs& pairs, Measures& measures);

}  // namespace powercell
