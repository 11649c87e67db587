/// \file
/// The point of a cell that is nearest to another. Internal.
#pragma once

#include <array>
#include <powercell/results.hpp>

namespace powercell {

/// \param x  third coordinate 0 in the plane   \return x itself if it is in the cell
/// \pre the cell has pieces
std::array<double, 3> nearest_in_cell(const Cells& cells, std::size_t cell, const std::array<double, 3>& x);

}  // namespace powercell
