#include "lib/base/positions.hpp"
#include "lib/domain/adjacency.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/measure.hpp"
#include "lib/domain/overlap.hpp"

namespace powercell {
namespace {

/// Area of a triangle, or 0 if it is flat.
long double triangle_area(const double* const* v) {
  const Vector ab = difference<long double>(v[1], v[0]), ac = difference<long double>(v[2], v[0]),
               bc = difference<long double>(v[2], v[1]);
  const long double longest2 = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  const long double twice = norm(cross(ab, ac));
  return twice <= flat_ratio * longest2 ? 0 : twice / 2;
}

/// Fills in the borders of all edges. An edge of one triangle bounds the surface. Of the triangles at an edge
/// of several, each has the next by index behind the edge, and the last one has the first.
/// \return repeated triangles; if there are any, borders are incomplete
Repeated connect(RegionMesh& mesh, const std::vector<std::uint32_t>& same) {
  const auto apex = [&](std::uint32_t slot) {
    return same[mesh.region_vertex[slot % 3 == 0 ? slot + 2 : slot - 1]];
  };
  Repeated repeated;
  std::vector<FacetKey<2>> edges(mesh.region_vertex.size());
  for (std::uint32_t slot = 0; slot < edges.size(); ++slot) {
    const std::uint32_t next = slot % 3 == 2 ? slot - 2 : slot + 1;
    const auto [a, b] = std::minmax(same[mesh.region_vertex[slot]], same[mesh.region_vertex[next]]);
    edges[slot] = {{a, b}, slot};
  }
  mesh.facet.assign(edges.size(), {Border::Kind::boundary, 0});
  for_each_shared(edges, [&](std::span<const FacetKey<2>> shared) {
    if (add_repeated(shared, mesh, apex, repeated)) return;
    for (std::size_t k = 0; shared.size() > 1 && k < shared.size(); ++k) {
      const std::uint32_t behind = shared[(k + 1) % shared.size()].slot / 3;
      mesh.facet[shared[k].slot] = {Border::Kind::interior, behind};
    }
  });
  number_boundary(mesh);
  return repeated;
}

}  // namespace

RegionMeshPtr build_surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  auto mesh = simplex_mesh(vertices, triangles, 3, triangle_area);
  const std::vector<std::uint32_t> same = first_at_position(mesh->vertices, 3);
  if (Repeated repeated = distinct(connect(*mesh, same)); !repeated.empty()) {
    mesh = simplex_mesh(vertices, triangles, 3, triangle_area, std::move(repeated));
    connect(*mesh, same);
  }
  find_overlapping_triangles(*mesh);
  return mesh;
}

}  // namespace powercell
