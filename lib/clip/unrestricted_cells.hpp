/// \file
/// Cells clipped in the container around the domain instead of in its regions.
#pragma once

#include <functional>

#include "lib/neighbors/candidates.hpp"
#include "lib/neighbors/cell_bounds.hpp"

namespace powercell {

/// Clips the cells of `ranks`, ascending, in the last region of the scene, and reads their neighbours and
/// vertices.
/// \param progress  called with the fraction done after each chunk; may be empty; returns false to stop
/// \pre the last region contains all others (with_container)
/// \throw Error as Clipper::clip; interrupted
CellWalls clip_unrestricted_cells(const Scene& scene, Candidates& candidates,
                                  std::span<const std::uint32_t> ranks,
                                  const std::function<bool(double)>& progress = {});

}  // namespace powercell
