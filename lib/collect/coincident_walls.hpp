/// \file
/// Walls that lie in the boundary of a solid because seeds tie with it.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

namespace powercell {

/// A part of the wall between two cells that lies in a boundary triangle. The first cell is in front of the
/// triangle, where nothing but an infinitesimal slice of it belongs to the solid.
struct CoincidentWall {
  std::uint32_t front, behind, triangle;
};

/// Makes such parts boundary of the cells behind. Cells in front lose them, with the triangle on their other
/// side.
/// \param walls  in any order
/// \param positions  of the seeds, 3 each
JoinedCells without_coincident_walls(const JoinedCells& cells, std::vector<CoincidentWall> walls,
                                     std::span<const double> positions);

}  // namespace powercell
