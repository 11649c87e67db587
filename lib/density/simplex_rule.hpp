/// \file
/// Nested cubature rules on simplices. Internal.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace powercell {

/// The invariant rules of Grundmann and Möller (SIAM J. Numer. Anal. 15, 1978) on a segment, triangle or
/// tetrahedron. Rule s is exact for polynomials of degree 2s+1, and its points are those of rule s-1 and
/// some more, so that going on costs only these and the difference tells the error (mathematics, (32)).
struct SimplexRules {
  static constexpr std::size_t count = 5;
  std::vector<std::array<double, 4>> point;       ///< barycentric coordinates, those of rule 0 first
  std::array<std::size_t, count> size{};          ///< rule s uses the points [0, size[s])
  std::array<std::vector<double>, count> weight;  ///< of the points of rule s; they sum to 1
};

/// \param dimension of the simplex: 1, 2 or 3
const SimplexRules& simplex_rules(int dimension);

}  // namespace powercell
