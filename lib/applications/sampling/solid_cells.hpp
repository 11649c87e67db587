/// \file
/// Cells in a solid, which are whole and not cut into convex pieces: projection of points to them, and their
/// parts.
#pragma once

#include <array>
#include <powercell/results.hpp>
#include <powercell/sampling.hpp>
#include <span>

namespace powercell {

/// The point of a cell nearest to x; x itself if it is in the cell.
/// \pre the cell is not empty
std::array<double, 3> nearest_in_cell(const JoinedCells& cells, std::size_t cell,
                                      const std::array<double, 3>& x);

/// As parts_apart() of convex pieces; parts share no edge.
/// \param positions  n x 3
PartsApart parts_apart(const JoinedCells& cells, std::span<const double> positions);

}  // namespace powercell
