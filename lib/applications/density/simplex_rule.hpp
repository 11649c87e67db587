/// \file
/// Nested cubature rules on simplices. Internal.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace powercell {

/// Coordinates of a point among the corners of a simplex, which sum to 1; those of a segment are two.
using Barycentric = std::array<double, 4>;

/// The invariant rules of Grundmann and Möller (SIAM J. Numer. Anal. 15, 1978) on a segment, triangle or
/// tetrahedron. Rule s is exact for polynomials of degree 2s+1, and its points are those of rule s-1 and
/// some more, so that going on costs only these and the difference tells the error (mathematics, (32)). The
/// points that a rule adds have one weight in each rule, so sums over them are all that is needed.
struct SimplexRules {
  static constexpr std::size_t count = 5;
  static constexpr std::size_t most_points = 70;  ///< of the last rule of a tetrahedron
  std::vector<Barycentric> point;                 ///< barycentric coordinates, those of rule 0 first
  std::array<std::size_t, count> size{};          ///< rule s uses the points [0, size[s])
  /// [s][k]: in rule s, of each point that rule k <= s has and k-1 has not; over all points they sum to 1.
  std::array<std::array<double, count>, count> weight{};
};

/// \param dimension of the simplex: 1, 2 or 3
const SimplexRules& simplex_rules(int dimension);

/// Points on the edges of a triangle, or on the faces of a tetrahedron, evenly spread, without the corners;
/// none of a segment.
const std::vector<Barycentric>& boundary_points(int dimension);

}  // namespace powercell
