/// \file
/// Loops in cells that are not discs.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/applications/remeshing/local_diagram.hpp"

namespace powercell::remeshing {

/// Points on about the shortest loop through a place in the cell of a seed that cannot be contracted within
/// the cell (docs/mathematics.md, "Remeshing"): at one and two thirds of its length, or at three thirds if
/// the loop is far from the place. Empty if every loop can be contracted, as in a disc, or if the place is
/// not in the cell.
std::vector<Place> points_around(const LocalDiagram& diagram, std::uint32_t seed, const Place& from);

/// About the point farthest from both seeds on the shortest such loop in the union of two cells that share
/// several walls, through a place in the first cell. Its triangle is `nothing` if there is no such loop.
Place point_between(const LocalDiagram& diagram, std::uint32_t a, std::uint32_t b, const Place& from);

}  // namespace powercell::remeshing
