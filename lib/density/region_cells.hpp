/// \file
/// The regions of a domain as cells. Internal.
#pragma once

#include <powercell/results.hpp>

#include "lib/domain/region_mesh.hpp"

namespace powercell {

/// A cell of one piece for each region, so that what integrates over cells integrates over the domain.
Cells region_cells(const RegionMesh& mesh);

}  // namespace powercell
