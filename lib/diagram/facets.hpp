/// \file
/// One pass over the regions at the domain's boundary: which facets each cell has.
#pragma once

#include <powercell/results.hpp>
#include <vector>

#include "lib/diagram/clip_plan.hpp"

namespace powercell {

/// \param plan    of the geometry
/// \param status  of the cells, by their place in the results
/// \throw Error interrupted, out_of_device_memory, opencl, build_failed, self_test_failed, internal
BoundaryWalls clip_facets(const DiagramSetup& setup, const ActiveSeeds& active, const ClipPlan& plan,
                          const std::vector<SeedStatus>& status);

}  // namespace powercell
