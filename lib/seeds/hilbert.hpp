/// \file
/// Points in Hilbert order. Internal.
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

}  // namespace powercell
