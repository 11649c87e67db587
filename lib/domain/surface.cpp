#include "lib/base/mesh_arrays.hpp"
#include "lib/domain/adjacency.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/measure.hpp"

namespace powercell {
namespace {

/// Area of a triangle, or 0 if it is flat.
long double triangle_area(const double* a, const double* b, const double* c) {
  const Vector ab = difference<long double>(b, a), ac = difference<long double>(c, a),
               bc = difference<long double>(c, b);
  const long double longest2 = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  const Vector normal = cross(ab, ac);
  const long double twice = std::sqrt(dot(normal, normal));
  return twice <= flat_ratio * longest2 ? 0 : twice / 2;
}

/// Borders of all edges. An edge of one triangle bounds the surface; an edge of several leads from
/// each triangle to the next by index, and from the last to the first.
void connect(RegionMesh& mesh) {
  const std::vector<std::uint32_t> same = weld(mesh.vertices, 3);
  std::vector<FacetKey<2>> edges(mesh.region_vertex.size());
  for (std::uint32_t slot = 0; slot < edges.size(); ++slot) {
    const std::uint32_t next = slot % 3 == 2 ? slot - 2 : slot + 1;
    const auto [a, b] = std::minmax(same[mesh.region_vertex[slot]], same[mesh.region_vertex[next]]);
    edges[slot] = {{a, b}, slot};
  }
  mesh.facet.assign(edges.size(), {Border::Kind::boundary, 0});
  for_each_shared(edges, [&](std::span<const FacetKey<2>> shared) {
    for (std::size_t k = 0; shared.size() > 1 && k < shared.size(); ++k) {
      const std::uint32_t behind = shared[(k + 1) % shared.size()].slot / 3;
      mesh.facet[shared[k].slot] = {Border::Kind::interior, behind};
    }
  });
  for (Border& border : mesh.facet) {
    if (border.kind == Border::Kind::boundary) border.index = mesh.boundary_count++;
  }
}

}  // namespace

RegionMeshPtr build_surface(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  check_simplices(vertices, triangles, 3, "triangle", "triangles");
  auto mesh = std::make_shared<RegionMesh>();
  mesh->kind = DomainKind::surface;
  mesh->shape = RegionShape::polygon;
  mesh->dimension = 3;
  mesh->cell_dimension = 2;
  mesh->vertices.assign(vertices.begin(), vertices.end());
  mesh->region_vertex.reserve(triangles.size());

  CompensatedSum<long double> area;
  for (std::size_t k = 0; k < triangles.size(); k += 3) {
    const double* at[3];
    for (std::size_t c = 0; c < 3; ++c) at[c] = &vertices[3 * std::size_t{triangles[k + c]}];
    const long double part = triangle_area(at[0], at[1], at[2]);
    if (part == 0) continue;
    area.add(part);
    mesh->region_vertex.insert(mesh->region_vertex.end(), &triangles[k], &triangles[k] + 3);
    mesh->source.push_back(static_cast<std::uint32_t>(k / 3));
  }
  if (mesh->source.empty()) {
    throw Error(
        ErrorCode::invalid_domain,
        "the domain is empty: all " + std::to_string(triangles.size() / 3) + " triangles have zero area");
  }
  for (std::uint32_t r = 0; r <= mesh->source.size(); ++r) mesh->region_offset.push_back(3 * r);
  mesh->facet_offset = mesh->region_offset;
  connect(*mesh);
  finish(*mesh, area);
  return mesh;
}

}  // namespace powercell
