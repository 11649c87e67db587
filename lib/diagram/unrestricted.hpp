/// \file
/// Cells that were clipped without the regions of the domain: which of them lie inside it? Internal.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <vector>

#include "lib/diagram/setup.hpp"

namespace powercell {

/// An unrestricted cell does not meet the boundary of the domain, so one point of it tells whether all of it
/// is inside. Those outside become hidden in `measures`. Any point of a cell that was cut by planes of the
/// boundary must be inside, in one region. \return the ranks of cells for which this cannot be told: too
/// thin, or where regions overlap
std::vector<std::uint32_t> classify_unrestricted_cells(const Setup& setup, const SeedSet& seeds,
                                                       const Pairs& pairs, Measures& measures);

}  // namespace powercell
