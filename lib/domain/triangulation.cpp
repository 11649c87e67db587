#include "lib/domain/triangulation.hpp"

#include <algorithm>

#include "lib/domain/adjacency.hpp"
#include "lib/domain/orient2d.hpp"
#include "lib/domain/touching.hpp"

namespace powercell {
namespace {

std::uint32_t next_in_triangle(std::uint32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}

/// Corners as vertex indices, each triangle counter-clockwise; empty if one is flat or has a corner
/// that is no vertex.
std::vector<std::uint32_t> index_corners(const IndexedRings& rings, const std::vector<double>& xy) {
  std::vector<std::uint32_t> corner(xy.size() / 2);
  for (std::size_t k = 0; k < corner.size(); ++k) {
    corner[k] = rings.find(xy[2 * k], xy[2 * k + 1]);
    if (corner[k] == rings.vertex_count()) return {};
  }
  for (std::size_t k = 0; k < corner.size(); k += 3) {
    const int turn = orient2d(rings.at(corner[k]), rings.at(corner[k + 1]), rings.at(corner[k + 2]));
    if (turn == 0) return {};
    if (turn < 0) std::swap(corner[k + 1], corner[k + 2]);
  }
  return corner;
}

using DirectedEdge = std::array<std::uint32_t, 2>;

std::vector<DirectedEdge> ring_edges(const IndexedRings& rings, std::size_t first, std::size_t last) {
  std::vector<DirectedEdge> edges;
  for (std::size_t r = first; r < last; ++r) {
    const auto& vertex = rings.rings[r].vertex;
    for (std::size_t k = 0; k < vertex.size(); ++k)
      edges.push_back({vertex[k], vertex[(k + 1) % vertex.size()]});
  }
  std::ranges::sort(edges);
  return edges;
}

/// Fills the twins; false unless half-edges without a twin are just the edges of the rings.
bool link(Triangulation& mesh, const std::vector<DirectedEdge>& boundary) {
  std::vector<FacetKey<2>> keys(mesh.corner.size());
  for (std::uint32_t h = 0; h < keys.size(); ++h) {
    const auto [a, b] = std::minmax(mesh.corner[h], mesh.corner[next_in_triangle(h)]);
    keys[h] = {{a, b}, h};
  }
  mesh.twin.assign(mesh.corner.size(), no_twin);
  bool good = true;
  std::vector<DirectedEdge> open;
  for_each_shared(keys, [&](std::span<const FacetKey<2>> shared) {
    const std::uint32_t h = shared[0].slot, from = mesh.corner[h];
    if (shared.size() == 1) {
      open.push_back({from, mesh.corner[next_in_triangle(h)]});
    } else if (shared.size() == 2 && mesh.corner[shared[1].slot] != from) {
      mesh.twin[h] = shared[1].slot;
      mesh.twin[shared[1].slot] = h;
    } else {
      good = false;
    }
  });
  std::ranges::sort(open);
  return good && open == boundary;
}

}  // namespace

Triangulation triangulate(geos::Context& geos, const IndexedRings& rings, std::size_t first,
                          std::size_t last) {
  Triangulation mesh;
  mesh.corner = index_corners(rings, geos.triangulate(geos.polygon(rings, first, last)));
  if (mesh.corner.empty() || !link(mesh, ring_edges(rings, first, last))) {
    const double* at = rings.at(rings.rings[first].vertex[0]);
    throw Error(ErrorCode::internal, "part " + std::to_string(rings.rings[first].part) + " (from " +
                                         place(at[0], at[1]) +
                                         "): no exact triangulation found; please report the polygon");
  }
  return mesh;
}

}  // namespace powercell
