/// \file
/// Which vertices of different cells are the same point.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/io/write/output.hpp"

namespace powercell::io {

/// The distinct points of a diagram, numbered in the order in which the vertices of its cells use them.
struct SharedPoints {
  std::vector<double> at;  ///< rows of 3 (third coordinate 0 in the plane)
  std::vector<std::uint32_t>
      number;  ///< per vertex of the pieces; of a solid, per vertex of the joined cells
  std::vector<std::uint8_t> between;  ///< per point: whether it lies in a facet between regions

  std::size_t size() const { return at.size() / 3; }
  const double* point(std::uint32_t p) const { return &at[3 * std::size_t{p}]; }
};

/// A vertex is named by the seeds whose cells meet there and by the part of the domain that it lies in: the
/// region, or the corners of the facet, edge or corner (of a solid, its triangles). Vertices of the same name
/// are the same point, in whichever cells; no distance decides that. Where more cells meet in a point than
/// its dimension asks for, as in a lattice, it has several names: points that are only rounding apart, 2^-44
/// of the largest coordinate, are united. In a periodic domain images of a point stay apart.
/// \throw Error unsupported (2^32 points or more)
SharedPoints share_points(const DiagramOutput& output);

}  // namespace powercell::io
