/// \file
/// Points in Hilbert order. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// Indices of the finite `points` (n x dimension, row-major) along a Hilbert curve through their bounding
/// cube. Where many points share a grid cell, the curve is refined in their own bounding cube, so that
/// clusters far below the grid's resolution are in good order too. Equal positions are consecutive, by
/// ascending index; the order does not depend on `threads`.
std::vector<std::uint32_t> hilbert_order(std::span<const double> points, int dimension, int threads);

}  // namespace powercell
