/// \file
/// What the neighbours of points say. Internal.
#pragma once

#include <powercell/point_sets.hpp>

namespace powercell {

struct Surroundings {
  Spacing spacing;        ///< of the points that have neighbours; NaN where none has
  double neighbours = 0;  ///< per point with a cell, on average
};

/// Points without a Voronoi cell, outside the domain or given twice, are left out. \param positions  n x d
/// \throw as Diagram
Surroundings surroundings(const Device& device, const Domain& domain, std::span<const double> positions,
                          bool periodic, bool uniform, const Options& options);

}  // namespace powercell
