/// \file
/// Points in Hilbert order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// Indices of the finite `points` (n x dimension, row-major) along a Hilbert curve through their bounding
/// cube. Points that share a grid cell are ordered along a curve through their own bounding cube, so clusters
/// far below the grid's resolution are in good order too. Equal positions are consecutive, by ascending
/// index. The order does not depend on `threads`.
std::vector<std::uint32_t> hilbert_order(std::span<const double> points, int dimension, int threads);

/// The places of points along one Hilbert curve through the cube at `low` that contains the box up to `high`:
/// of 62 or 63 bits, equal for points that share a cell of its grid.
/// \pre the points are in the box; `low` and `high` have `dimension` finite coordinates unless there are no
/// points
std::vector<std::uint64_t> hilbert_keys(std::span<const double> points, int dimension,
                                        std::span<const double> low, std::span<const double> high,
                                        int threads);

}  // namespace powercell
