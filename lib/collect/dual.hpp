/// \file
/// The dual of a power diagram, from the geometry of its cells, also in a periodic domain.
#pragma once

#include <array>
#include <powercell/results.hpp>
#include <powercell/seeds.hpp>
#include <span>

namespace powercell {

/// One simplex for each point in which three (polygon, surface) or four (volume) cells meet, except cells
/// without pieces. A set of seeds gives one row even if its cells meet in several points of a surface. A row
/// starts with its smallest seed, in volumes followed by the second smallest. Rows are oriented positively by
/// the exact positions of the seeds. On a surface, and for collinear seeds in the plane, the cells are in
/// counter-clockwise order around the point; four coplanar seeds are ascending.
/// \pre pieces are simple, as the clipper makes them: three faces meet at each vertex of a polyhedron
Dual make_dual(const Cells& cells, const SeedsView& seeds);

/// Rows of four seeds whose cells meet at a vertex of a polyhedral piece, as in make_dual(), with
/// repetitions.
std::vector<std::uint32_t> corners_of_cells(const Cells& cells);

/// `dual` with further simplices of a polygon or volume; repeated ones have no effect.
/// \param rows  of seed indices, in any order
Dual extend_dual(const Dual& dual, const std::vector<std::uint32_t>& rows, const SeedsView& seeds);

/// One simplex for each point, up to translations, in which three (plane) or four (space) cells meet. A row
/// starts with its smallest seed, of shift 0; of the rows that translations make of it, it is the one first
/// in order.
/// \param positions  of the seeds as given
/// \param periods  the vectors that Cells::shift counts
/// \pre pieces are simple, as the clipper makes them: three faces meet at each vertex of a polyhedron
Dual make_periodic_dual(const Cells& cells, std::span<const double> positions,
                        const std::array<std::array<double, 3>, 3>& periods);

}  // namespace powercell
