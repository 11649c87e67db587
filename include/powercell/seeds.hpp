/// \file
/// Seeds: the weighted points whose power cells are computed.
#pragma once

#include <cstddef>
#include <span>

namespace powercell {

/// The most seeds of one diagram.
inline constexpr std::size_t most_seeds_of_diagram = std::size_t{1} << 30;

/// A view of n seeds in host memory; the caller owns the arrays, which must last for the call.
/// The power distance of x to seed i is |x - p_i|^2 - w_i, so a weight has the unit length^2
/// (for a disc or ball of radius r around p_i, w_i = r^2), may have any sign, and a constant added
/// to all weights changes nothing.
struct SeedsView {
  int dimension = 0;                  ///< d: 2 for polygons, 3 for surfaces and volumes
  std::span<const double> positions;  ///< n x d, row-major, unit length
  std::span<const double> weights;    ///< n, unit length^2; empty means all zero

  std::size_t size() const {
    return dimension > 0 ? positions.size() / static_cast<std::size_t>(dimension) : 0;
  }
};

}  // namespace powercell
