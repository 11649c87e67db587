/// \file
/// Validity of a list of triangles, and whether it is an oriented manifold.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace powercell::remeshing {

/// Checks sizes, indices, finiteness and the magnitude of the used coordinates, as Domain::surface does.
/// \param vertices   nv x 3
/// \param triangles  nt x 3
/// \throw Error invalid_domain
void check_triangles(std::span<const double> vertices, std::span<const std::uint32_t> triangles);

/// A directed edge, or an undirected one if `from` < `to`, as a key.
inline std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

struct MeshCheck {
  std::vector<std::uint32_t> not_manifold;  ///< vertices of bad edges or with several fans; with repetitions
  std::vector<std::pair<std::uint32_t, std::uint32_t>> boundary_edges;  ///< directed as in their triangles
  std::vector<bool> used;                                               ///< per vertex: a triangle has it
  int euler = 0;
  int loops = 0;                     ///< number of boundary loops, if the mesh is a manifold
  std::vector<std::uint64_t> edges;  ///< keys of the directed edges, sorted

  bool has_edge(std::uint32_t from, std::uint32_t to) const;
};

/// \param vertices  their number
MeshCheck check_mesh(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices);

}  // namespace powercell::remeshing
