/// \file
/// Nested cubature rules on simplices.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace powercell {

/// Barycentric coordinates of a point of a simplex. They sum to 1; unused ones are 0.
using Barycentric = std::array<double, 4>;

/// The invariant rules of Grundmann and Möller (SIAM J. Numer. Anal. 15, 1978) on a segment, triangle or
/// tetrahedron, (32). Rule s is exact for polynomials of degree 2s+1. The rules are nested: rule s adds
/// points to those of rule s-1, so the next rule costs only the added points, and the difference of two rules
/// estimates the error. All points that a rule adds have the same weight in each rule, so their sums suffice.
struct SimplexRules {
  static constexpr std::size_t count = 5;
  static constexpr std::size_t most_points = 70;  ///< points of the last rule of a tetrahedron
  std::vector<Barycentric> point;                 ///< those of rule 0 first
  std::array<std::size_t, count> size{};          ///< rule s uses the points [0, size[s])
  /// [s][k]: the weight in rule s of each point that rule k <= s adds; over all points they sum to 1.
  std::array<std::array<double, count>, count> weight{};
};

/// \param dimension  of the simplex: 1, 2 or 3
const SimplexRules& simplex_rules(int dimension);

/// A lattice of points on the edges of a triangle or the faces of a tetrahedron, without the corners; empty
/// for a segment.
const std::vector<Barycentric>& boundary_points(int dimension);

}  // namespace powercell
