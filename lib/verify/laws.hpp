/// \file
/// The laws, one function each. Internal.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lib/domain/random_points.hpp"
#include "lib/verify/law.hpp"
#include "lib/verify/rounding.hpp"

namespace powercell {

/// Every statement of SeedStatus: ok exactly with a positive measure and a piece, hidden and duplicate with
/// neither; at each position one seed that is not a duplicate, of the largest weight, then the lowest index.
LawCheck check_statuses(const Measures& measures, const Cells& cells, const SeedsView& seeds);

/// Rows ascending and equal from both sides, and little asymmetry before the sides were averaged.
LawCheck check_walls(const Adjacency& adjacency, const Domain& domain, const Rounding& rounding);

/// Each sample lies in a piece of the seed of least power, found by trying all seeds.
LawCheck check_owners(const std::vector<Sample>& samples, const RegionMesh& mesh, const Cells& cells,
                      const Rounding& rounding);

/// The pieces of each cell sum to its measure, and their centroid is its centroid.
std::vector<LawCheck> check_pieces(const Measures& measures, const Cells& cells, const Rounding& rounding);

/// The neighbours of seed i.
inline std::span<const std::uint32_t> row_of(const Adjacency& adjacency, std::size_t i) {
  return std::span(adjacency.neighbor)
      .subspan(adjacency.offset[i], adjacency.offset[i + 1] - adjacency.offset[i]);
}

/// Vertex v of the cells' array.
inline Vector cell_vertex(const Cells& cells, std::uint64_t v) {
  const double* x = &cells.vertices[v * static_cast<std::size_t>(cells.dimension)];
  return {x[0], x[1], cells.dimension == 3 ? x[2] : 0.0};
}
/// Corner k of face f: of a polyhedron's loop, or of the edge k of a polygon.
std::vector<Vector> face_corners(const Cells& cells, std::size_t piece, std::uint64_t face);

}  // namespace powercell
