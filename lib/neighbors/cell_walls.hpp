/// \file
/// Whole cells: their neighbours and vertices. Internal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// By rank; nothing of cells that were not asked for. A seed that is its own only neighbour has no cell.
struct CellWalls {
  int dimension = 0;
  std::vector<std::uint32_t> offset;  ///< seeds + 1
  std::vector<std::uint32_t> neighbor;
  std::vector<std::uint64_t> vertex_offset;  ///< seeds + 1, in vertices; empty if they are not known
  std::vector<double> vertex;                ///< relative to the seed
  double vertex_error = 0;  ///< vertices are this near to the true ones, relative to the farthest of the cell

  std::span<const std::uint32_t> of(std::uint32_t rank) const {
    return std::span(neighbor).subspan(offset[rank], offset[rank + 1] - offset[rank]);
  }
  std::span<const double> vertices_of(std::uint32_t rank) const {
    if (vertex_offset.empty()) return {};
    const auto d = static_cast<std::size_t>(dimension);
    return std::span(vertex).subspan(vertex_offset[rank] * d,
                                     (vertex_offset[rank + 1] - vertex_offset[rank]) * d);
  }
};

}  // namespace powercell
