/// \file
/// What a list of triangles must be, and what makes it an oriented manifold.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell::remeshing {

/// Refuses triangles that cannot be computed with: sizes, indices and finite coordinates have to be as
/// Domain::surface wants them, coordinates of vertices that are used of a magnitude as it does.
/// \param vertices nv x 3   \param triangles nt x 3
/// \throw Error invalid_domain
void check_triangles(std::span<const double> vertices, std::span<const std::uint32_t> triangles);

/// A directed edge, or an undirected one if `from` < `to`, as a key.
inline std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

struct MeshCheck {
  std::vector<std::uint32_t> not_manifold;  ///< vertices of bad edges and of several fans, not distinct
  std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary_edges;  ///< directed as in their triangle
  std::vector<bool> used;                                               ///< per vertex
  int euler = 0;
  int loops = 0;                     ///< of the boundary; right where all is manifold
  std::vector<std::uint64_t> edges;  ///< keys of the directed edges, sorted

  bool has_edge(std::uint32_t from, std::uint32_t to) const;
};

MeshCheck check_mesh(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices);

}  // namespace powercell::remeshing
