/// \file
/// Cells of the whole space around the domain, each clipped in one piece. Internal.
#pragma once

#include "lib/neighbors/candidates.hpp"
#include "lib/neighbors/cell_bounds.hpp"

namespace powercell {

/// Clips the cells of `ranks`, ascending, in the last region of the scene, and reads their neighbours and
/// vertices. Waits for the device. \pre the last region holds all others (with_container) \throw Error as
/// Clipper
CellWalls clip_unrestricted_cells(const Scene& scene, Candidates& candidates,
                                  std::span<const std::uint32_t> ranks);

}  // namespace powercell
