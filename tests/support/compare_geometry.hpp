/// \file
/// The geometry of cells checked against itself and against the measures: sizes, orientation, closed
/// surfaces, borders, and what joining must keep.
#pragma once

#include <powercell/diagram.hpp>
#include <vector>

#include "tests/support/compare.hpp"

namespace powercell::test {

/// Arrays of consistent sizes, indices in range, pieces oriented as promised (edges of a piece of
/// polyhedron once in each direction), measures of the pieces adding up to the cells', and wall faces
/// adding up to the adjacency.
Differences check_cells(const Cells& cells, const Domain& domain, const Measures& measures,
                        const Adjacency& adjacency, const Tolerances& tolerances);

/// Measures kept, nothing interior left between pieces of a cell (on surfaces, which stay cut by their
/// triangles, interior edges remain), rings and faces oriented as promised.
Differences check_joined(const JoinedCells& joined, const Domain& domain, const Measures& measures,
                         const Tolerances& tolerances);

}  // namespace powercell::test
