/// \file
/// Diagrams for the tests of the writers, computed by clipping every region by every seed, independently of
/// the library.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "apps/io/write/output.hpp"

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

/// Clips, measures, joins. Seeds at the same position are treated as SeedStatus describes.
MadeDiagram make_diagram(const Domain& domain, std::vector<double> positions, std::vector<double> weights);

/// In [low, high). Reproducible on every machine, unlike the distributions of <random>.
inline double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

/// A wavy shape with a hole. Of the `n` weighted seeds some are hidden, two share a position and every fifth
/// has a negative weight.
MadeDiagram polygon_diagram(int n);
/// A torus.
MadeDiagram surface_diagram(int n);
/// The unit cube in tetrahedra.
MadeDiagram volume_diagram(int n);

}  // namespace powercell::test
