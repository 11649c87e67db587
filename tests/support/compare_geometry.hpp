/// \file
/// Consistency checks of the geometry of cells, joined or not, and comparisons to the measures.
#pragma once

#include <powercell/diagram.hpp>
#include <vector>

#include "tests/support/compare.hpp"

namespace powercell::test {

/// Checks sizes of arrays, ranges of indices, orientation of pieces (each edge of a polyhedron once in each
/// direction), that the pieces sum to the measures of cells, and the faces to the walls of the adjacency.
Differences check_cells(const Cells& cells, const Domain& domain, const Measures& measures,
                        const Adjacency& adjacency, const Tolerances& tolerances);

/// Checks that measures are unchanged, no interior edges or faces are left between pieces of a cell (except
/// on surfaces, which stay cut by their triangles), and rings and faces are oriented.
Differences check_joined(const JoinedCells& joined, const Domain& domain, const Measures& measures,
                         const Tolerances& tolerances);

}  // namespace powercell::test
