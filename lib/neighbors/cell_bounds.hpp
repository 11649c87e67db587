/// \file
/// The walls of cells with other cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// Neighbours and vertices of unrestricted cells, by rank. A cell that was not clipped has none; a seed whose
/// cell is empty has itself as its only neighbour.
struct CellWalls {
  int dimension = 0;
  std::vector<std::uint32_t> offset;  ///< seeds + 1
  std::vector<std::uint32_t> neighbor;
  std::vector<std::uint64_t> vertex_offset;  ///< seeds + 1, in vertices; empty if vertices are not known
  std::vector<double> vertex;                ///< relative to the seed
  double vertex_error = 0;  ///< bound for a vertex, relative to the distance of its cell's farthest vertex

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
