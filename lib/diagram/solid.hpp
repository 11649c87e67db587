/// \file
/// Adds the cells computed from the boundary to those clipped as wholes, and finds which of these lie inside.
#pragma once

#include <vector>

#include "lib/collect/join_solid.hpp"
#include "lib/collect/walls.hpp"
#include "lib/diagram/clip_plan.hpp"
#include "lib/integrate/moment_sums.hpp"

namespace powercell {

struct SolidSides {
  std::vector<std::uint32_t> outside;    ///< ranks of cells clipped as wholes that lie outside
  std::vector<std::uint32_t> unclear;    ///< ranks of cells whose side contradicts itself
  std::vector<std::uint32_t> flat;       ///< ranks of cells in a solid no thicker than rounding
  std::vector<CellAtBoundary> geometry;  ///< of all other cells at the boundary, if the plan has it
};

/// \pre plan.solid, and all pairs of the plan were added to `measures` and `walls`
SolidSides add_solid_cells(const DiagramSetup& setup, const ActiveSeeds& active, const ClipPlan& plan,
                           MomentSums& measures, WallCollector& walls);

}  // namespace powercell
