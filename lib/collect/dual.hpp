/// \file
/// The dual of a power diagram, read off the geometry of its cells. Internal.
#pragma once

#include <powercell/results.hpp>
#include <powercell/seeds.hpp>

namespace powercell {

/// The simplices of the points in which three (polygon, surface) or four (volume) cells meet; seeds without
/// pieces have none.
/// Pieces are simple, as the clipper makes them: three faces meet at a vertex of a polyhedron.
/// Each set of seeds gives one row, also where its cells meet in several points of a surface. A row starts
/// with its smallest seed; in volumes the second smallest follows. Rows are oriented by the positions of
/// the seeds; on a surface, and in the plane where the seeds are collinear up to rounding, the cells follow
/// each other counter-clockwise around the point. Four seeds that are coplanar up to rounding are
/// ascending.
Dual make_dual(const Cells& cells, const SeedsView& seeds);

/// With further simplices of a polygon or volume, rows of seed indices in any order; those that are there
/// already change nothing.
Dual extend_dual(const Dual& dual, const std::vector<std::uint32_t>& rows, const SeedsView& seeds);

}  // namespace powercell
