/// \file
/// The work counted for a cell, in operations and bytes, from the geometry of the cells
/// (docs/performance.md, "The work counted for a cell").
#pragma once

#include <cstddef>
#include <powercell/powercell.hpp>

#include "apps/io/read/domain.hpp"

namespace powercell::app {

/// Means over the seeds. A piece is the part of a cell in one convex region of the domain.
struct Work {
  int dimension = 0;       ///< coordinates
  int cell_dimension = 0;  ///< 2 or 3
  double pieces = 0;
  double corners = 0;       ///< of all pieces of a cell together, and so on
  double triangles = 0;     ///< of a fan over every face (volumes) or over the piece
  double near = 0;          ///< seeds near enough to cut a piece
  double corner_tests = 0;  ///< the same, each times the corners of its piece

  double operations() const;                     ///< additions, multiplications, divisions, comparisons
  double bytes(std::size_t bytes_a_real) const;  ///< of device memory, each number once
};

/// Counts the work for the cells of the seeds at `positions`.
Work count_work(const Domain& domain, const Cells& cells, std::span<const double> positions);

/// The lowest part of the domain, about `share` (0 to 1) of its measure, where fewer seeds have the same
/// density relative to the regions. Domains of one region and polygons are returned whole.
Domain part_of(const io::LoadedDomain& domain, double share);

}  // namespace powercell::app
