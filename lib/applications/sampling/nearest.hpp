/// \file
/// Projection of points to cells. Internal.
#pragma once

#include <array>
#include <powercell/results.hpp>

namespace powercell {

/// The point of a cell nearest to x; x itself if it is in the cell.
/// \pre the cell is not empty
/// \param x  third coordinate 0 in the plane
std::array<double, 3> nearest_in_cell(const Cells& cells, std::size_t cell, const std::array<double, 3>& x);

}  // namespace powercell
