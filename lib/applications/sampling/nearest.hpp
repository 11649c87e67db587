/// \file
/// Projection of points to cells.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/results.hpp>
#include <span>

namespace powercell {

/// The point of a cell nearest to x; x itself if it is in the cell.
/// \pre the cell is not empty
/// \param x  third coordinate 0 in the plane
std::array<double, 3> nearest_in_cell(const Cells& cells, std::size_t cell, const std::array<double, 3>& x);

/// The point of a convex polygon, or of a line from one point to another, nearest to x.
std::array<double, 3> nearest_in_polygon(std::span<const std::array<double, 3>> polygon,
                                         const std::array<double, 3>& x);

/// The point of a piece nearest to x.
std::array<double, 3> nearest_in_piece(const Cells& cells, std::uint64_t piece,
                                       const std::array<double, 3>& x);

}  // namespace powercell
