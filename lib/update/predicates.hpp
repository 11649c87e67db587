/// \file
/// Signs of determinants of seeds, exact where rounding leaves them open. Internal.
#pragma once

#include <array>
#include <cstddef>
#include <exception>

namespace powercell {

/// A seed: x y z weight; z is 0 in the plane.
using Site = std::array<double, 4>;

/// Thrown where a kept mesh cannot go on: seeds tie, or the mesh is too far from the diagram to be repaired.
/// The diagram is then computed anew.
class MeshUnusable : public std::exception {
 public:
  const char* what() const noexcept override { return "the dual mesh of the diagram cannot be used"; }
};

/// Sign of det(b - a, c - a, d - a), or det(b - a, c - a): positive if the corners are in positive order.
int orientation(const std::array<const Site*, 4>& corner);
int orientation(const std::array<const Site*, 3>& corner);

/// Whether `site` has a cell among the corners of a positive simplex: +1 if its power distance from the point
/// that is as near to all corners is below theirs, -1 if it is above, 0 in a tie.
int conflict_sign(const std::array<const Site*, 4>& corner, const Site& site);
int conflict_sign(const std::array<const Site*, 3>& corner, const Site& site);

}  // namespace powercell
