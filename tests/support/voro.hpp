/// \file
/// voro++'s radical Voronoi cells in a box.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/generators.hpp"

namespace powercell::test {

/// Of n seeds in space.
struct RadicalCells {
  std::vector<double> volume;           ///< n; 0 for cells that voro++ finds empty
  std::vector<std::uint64_t> offset;    ///< n + 1
  std::vector<std::uint32_t> neighbor;  ///< ascending within a row; each row is from that cell only
  std::vector<double> wall;             ///< area
};

/// Weights may have any sign: voro++ takes radii, so the least weight is subtracted from all.
/// \pre every seed lies in the box (voro++ ignores others)
RadicalCells radical_cells(const SeedsView& seeds, const Box& box);

}  // namespace powercell::test
