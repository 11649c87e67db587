/// \file
/// The regions of a domain as cells. Internal.
#pragma once

#include <powercell/regions.hpp>
#include <powercell/results.hpp>

namespace powercell {

/// A cell of one piece for each region, so that what integrates over cells integrates over the domain.
Cells region_cells(const RegionsView& mesh);

}  // namespace powercell
