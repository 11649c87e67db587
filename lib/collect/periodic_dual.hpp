/// \file
/// The dual of a diagram of a periodic domain. Internal.
#pragma once

#include <array>
#include <powercell/results.hpp>
#include <span>

namespace powercell {

/// One simplex for each point, up to translations, in which three (plane) or four (space) cells meet. A row
/// starts with its smallest seed, of shift 0; of the rows that translations make of it, it is the one first
/// in order. \param positions  of the seeds as given \param periods    the vectors that Cells::shift counts
/// \pre pieces are simple, as the clipper makes them: three faces meet at each vertex of a polyhedron
Dual make_periodic_dual(const Cells& cells, std::span<const double> positions,
                        const std::array<std::array<double, 3>, 3>& periods);

}  // namespace powercell
