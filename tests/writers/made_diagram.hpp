/// \file
/// Diagrams for tests of writers, computed here by clipping every region by every seed: the writers are
/// tested apart from the pipeline that feeds them.
#pragma once

#include <string>
#include <vector>

#include "apps/io/output.hpp"

namespace powercell::test {

struct MadeDiagram {
  Domain domain;
  std::vector<double> positions, weights;
  Measures measures;
  Cells cells;
  JoinedCells joined;
  Adjacency adjacency;

  io::DiagramOutput output() const {
    return {domain, {domain.dimension(), positions, weights}, measures, cells, joined, adjacency};
  }
};

/// Clips, measures, joins. Seeds at one position are told apart as SeedStatus says.
MadeDiagram make_diagram(const Domain& domain, std::vector<double> positions, std::vector<double> weights);

/// A wavy blob with a hole; `n` weighted seeds, of which some are hidden, two share a place and every
/// fifth has a negative weight.
MadeDiagram polygon_diagram(int n);
/// A torus in cells.
MadeDiagram surface_diagram(int n);
/// The unit cube as tetrahedra, in cells.
MadeDiagram volume_diagram(int n);

}  // namespace powercell::test
