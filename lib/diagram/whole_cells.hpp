/// \file
/// Cells that were clipped in one piece, without the regions of the domain: are they inside? Internal.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <vector>

#include "lib/pairs/enumerate.hpp"

namespace powercell {

/// A cell with a pair with the container does not meet the boundary of the domain, so any point of it tells
/// whether all of it is inside. Those that are outside become hidden in `measures`. Of a cell that was cut by
/// planes of the boundary any point tells that it is inside, in one region. \param float32  the moments were
/// computed in single precision \return the ranks of cells that cannot be told: too thin, or where regions
/// overlap
std::vector<std::uint32_t> settle_whole_cells(const RegionMesh& mesh, PairFinder& finder, const Pairs& pairs,
                                              const SeedSet& seeds, bool float32, int threads,
                                              Measures& measures);

}  // namespace powercell
