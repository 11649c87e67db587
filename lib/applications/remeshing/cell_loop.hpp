/// \file
/// The way around a cell that is no disc.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/applications/remeshing/local_diagram.hpp"

namespace powercell::remeshing {

/// About the shortest closed path from a place in the cell of a seed that no move within the cell draws
/// together (docs/mathematics.md, "Remeshing"): points at one and two thirds of it, or three where it goes
/// around far from that place; none where all paths can be drawn together, as in a disc, or where the place
/// is not in the cell.
std::vector<Place> points_around(const LocalDiagram& diagram, std::uint32_t seed, const Place& from);

/// Of the shortest such path in the cells of two seeds that meet more than once, through the place in the
/// cell of the first: about its point farthest from both. Of triangle `nothing` if there is no such path.
Place point_between(const LocalDiagram& diagram, std::uint32_t a, std::uint32_t b, const Place& from);

}  // namespace powercell::remeshing
