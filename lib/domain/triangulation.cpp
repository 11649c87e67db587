#include "lib/domain/triangulation.hpp"

#include <algorithm>

#include "lib/domain/adjacency.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell {
namespace {

std::uint32_t next_in_triangle(std::uint32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}

bool all_positive(const IndexedRings& vertices, const std::vector<std::uint32_t>& corner) {
  for (std::size_t k = 0; k < corner.size(); k += 3) {
    if (orient2d(vertices.at(corner[k]), vertices.at(corner[k + 1]), vertices.at(corner[k + 2])) <= 0)
      return false;
  }
  return !corner.empty();
}

using DirectedEdge = std::array<std::uint32_t, 2>;

std::vector<DirectedEdge> ring_edges(std::span<const IndexedRing> rings) {
  std::vector<DirectedEdge> edges;
  for (const IndexedRing& ring : rings) {
    const std::size_t n = ring.vertex.size();
    for (std::size_t k = 0; k < n; ++k) edges.push_back({ring.vertex[k], ring.vertex[(k + 1) % n]});
  }
  std::ranges::sort(edges);
  return edges;
}

/// Fills in the twins; false unless the half-edges without a twin are exactly the edges of the rings.
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

Triangulation triangulate(const IndexedRings& vertices, std::span<const IndexedRing> rings) {
  const std::vector<DirectedEdge> boundary = ring_edges(rings);
  Triangulation mesh;
  mesh.corner = sweep_triangulate(vertices, rings);
  bool good = link(mesh, boundary);
  if (good) {
    make_delaunay(vertices, mesh);
    good = all_positive(vertices, mesh.corner) && link(mesh, boundary);
  }
  if (good) return mesh;
  const double* at = vertices.at(rings[0].vertex[0]);
  throw Error(ErrorCode::invalid_domain,
              "part " + std::to_string(rings[0].part) + " (from " + place(at[0], at[1]) +
                  "): edges cross by less than rounding; snap its points to a grid");
}

}  // namespace powercell
