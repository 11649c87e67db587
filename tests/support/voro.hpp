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

/// The volumes of the cells in a box with periodic axes. Weights must not be negative.
std::vector<double> periodic_volumes(const SeedsView& seeds, const Box& box, std::array<bool, 3> periodic);
/// The same in the lattice of (bx, 0, 0), (bxy, by, 0), (bxz, byz, bz). \param unit  bx bxy by bxz byz bz
std::vector<double> triclinic_volumes(const SeedsView& seeds, const std::array<double, 6>& unit);

}  // namespace powercell::test
