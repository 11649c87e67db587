/// \file
/// CGAL's regular triangulation (exact predicates) in plain arrays: hidden seeds of the unbounded diagram,
/// neighbours, and the simplices of the dual.
#pragma once

#include <cstdint>
#include <powercell/seeds.hpp>
#include <vector>

namespace powercell::test {

/// Of n seeds at distinct positions.
struct RegularTriangulation {
  std::vector<std::uint8_t> hidden;      ///< n: 1 if the unbounded cell is empty
  std::vector<std::uint64_t> offset;     ///< n + 1
  std::vector<std::uint32_t> neighbor;   ///< finite edges, both directions, ascending within a row
  std::vector<std::uint32_t> simplices;  ///< finite triangles or tetrahedra, d+1 seeds each
};

RegularTriangulation regular_triangulation(const SeedsView& seeds);

}  // namespace powercell::test
