/// \file
/// Statistics of Voronoi neighbours.
#pragma once

#include <powercell/point_sets.hpp>

namespace powercell {

struct NeighbourStatistics {
  Spacing spacing;        ///< over the points with neighbours; NaN if there are none
  double neighbours = 0;  ///< mean number over the points with a cell
};

/// As spacing(), but leaves out points without a Voronoi cell (outside the domain or given twice).
/// \throw as Diagram
NeighbourStatistics neighbour_statistics(const Device& device, const Domain& domain,
                                         std::span<const double> positions, bool periodic, bool uniform,
                                         const Options& options);

}  // namespace powercell
