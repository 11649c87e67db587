/// \file
/// What bounds a cell: its walls with other cells, and planes of the domain's boundary. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell {

/// The neighbours and vertices of unrestricted cells, by rank; cells that were not asked for have none. A
/// seed whose cell is empty is its own only neighbour.
struct CellWalls {
  int dimension = 0;
  std::vector<std::uint32_t> offset;  ///< seeds + 1
  std::vector<std::uint32_t> neighbor;
  std::vector<std::uint64_t> vertex_offset;  ///< seeds + 1, in vertices; empty if they are not known
  std::vector<double> vertex;                ///< relative to the seed
  double vertex_error = 0;  ///< of a vertex, as a fraction of the distance of the farthest vertex of its cell

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

/// The plane of a boundary facet, relative to a seed: the domain is where normal . y <= offset.
struct LocalPlane {
  std::array<double, 3> normal;  ///< of unit length
  double offset;
  double error;  ///< bound of its distance from the true plane within the cell
};

/// The cells that are cut by planes of the boundary instead of the regions of the domain
/// (docs/mathematics.md, "Cells at the boundary").
struct CellPlanes {
  std::vector<std::uint32_t> rank;  ///< ascending
  std::vector<std::uint64_t> end;   ///< per rank: end of its planes
  std::vector<LocalPlane> plane;
};

}  // namespace powercell
