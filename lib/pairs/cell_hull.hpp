/// \file
/// The vertices and bounding box of one cell. Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "lib/neighbors/cell_bounds.hpp"
#include "lib/pairs/wall_loops.hpp"

namespace powercell::pairs {

/// Coordinates are relative to the seed. The memory is reused from cell to cell.
struct CellHull {
  int dimension = 0;
  std::vector<double> vertex;       ///< all x, all y, all z; each padded to whole lanes with the last vertex
  std::array<double, 3> low, high;  ///< contains the true cell; the whole space if vertices are not known
  double error = 0;                 ///< bound for the distance of a vertex from the true one

  void set(const CellWalls& cells, std::uint32_t rank) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const std::span<const double> from = cells.vertices_of(rank);
    dimension = cells.dimension;
    const auto d = static_cast<std::size_t>(dimension);
    const std::size_t count = d == 0 ? 0 : from.size() / d;
    const std::size_t columns = (count + RegionGroups::fan - 1) / RegionGroups::fan * RegionGroups::fan;
    vertex.resize(columns * d);
    low.fill(-infinite);
    high.fill(infinite);
    error = 0;
    if (count == 0) return;
    for (std::size_t k = 0; k < d; ++k) {
      low[k] = infinite;
      high[k] = -infinite;
      for (std::size_t v = 0; v < columns; ++v) {
        const double x = from[std::min(v, count - 1) * d + k];
        vertex[k * columns + v] = x;
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
      }
      error += std::max(std::abs(low[k]), std::abs(high[k]));
    }
    error *= cells.vertex_error;
    for (std::size_t k = 0; k < d; ++k) {
      low[k] -= error;
      high[k] += error;
    }
  }

  bool empty() const { return vertex.empty(); }
  /// The least of direction . vertex.
  double least_along(const double* direction) const {
    return loops::least_along(direction, dimension, vertex.data(),
                              vertex.size() / static_cast<std::size_t>(dimension));
  }
};

}  // namespace powercell::pairs
