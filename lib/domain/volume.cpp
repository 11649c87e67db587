#include "lib/base/mesh_arrays.hpp"
#include "lib/domain/adjacency.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/measure.hpp"

namespace powercell {
namespace {

/// Six times the signed volume, or 0 if the tetrahedron is flat.
long double determinant(const std::array<const double*, 4>& v) {
  const Vector a = difference<long double>(v[1], v[0]), b = difference<long double>(v[2], v[0]),
               c = difference<long double>(v[3], v[0]);
  const Vector ab = cross(a, b), bc = cross(b, c), ca = cross(c, a);
  const Vector far_facet = cross(difference<long double>(v[2], v[1]), difference<long double>(v[3], v[1]));
  const Vector bc_edge = difference<long double>(v[3], v[2]), ab_edge = difference<long double>(v[2], v[1]),
               ac_edge = difference<long double>(v[3], v[1]);
  const long double longest2 = std::max(
      {dot(a, a), dot(b, b), dot(c, c), dot(ab_edge, ab_edge), dot(ac_edge, ac_edge), dot(bc_edge, bc_edge)});
  const long double facet2 = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca), dot(far_facet, far_facet)});
  const long double value = dot(a, bc);  // = least height times twice the largest facet
  return std::fabs(value) <= flat_ratio * std::sqrt(longest2) * std::sqrt(facet2) ? 0 : value;
}

std::string name_sources(const RegionMesh& mesh, std::span<const FacetKey<3>> shared) {
  std::string names;
  for (std::size_t k = 0; k < shared.size(); ++k) {
    names += (k == 0 ? "" : k + 1 == shared.size() ? " and " : ", ");
    names += std::to_string(mesh.source[shared[k].slot / 4]);
  }
  return names;
}

/// True if the two facets run the same way around, i.e. both regions lie on the same side.
bool same_side(const RegionMesh& mesh, const std::vector<std::uint32_t>& same,
               std::span<const FacetKey<3>> shared) {
  bool even[2];
  for (int k = 0; k < 2; ++k) {
    const std::uint32_t slot = shared[k].slot;
    const std::uint32_t* region = &mesh.region_vertex[slot / 4 * 4];
    std::uint32_t v[3];
    for (int c = 0; c < 3; ++c) v[c] = same[region[tetrahedron_facet[slot % 4][c]]];
    even[k] = ((v[0] < v[1]) + (v[1] < v[2]) + (v[2] < v[0])) == 2;
  }
  return even[0] == even[1];
}

/// Borders of all facets. A facet of one tetrahedron bounds the volume.
void connect(RegionMesh& mesh) {
  const std::vector<std::uint32_t> same = weld(mesh.vertices, 3);
  std::vector<FacetKey<3>> facets(mesh.region_vertex.size());
  for (std::uint32_t slot = 0; slot < facets.size(); ++slot) {
    const std::uint32_t* region = &mesh.region_vertex[slot / 4 * 4];
    for (int c = 0; c < 3; ++c) facets[slot].vertex[c] = same[region[tetrahedron_facet[slot % 4][c]]];
    std::sort(facets[slot].vertex.begin(), facets[slot].vertex.end());
    facets[slot].slot = slot;
  }
  mesh.facet.assign(facets.size(), {Border::Kind::boundary, 0});
  for_each_shared(facets, [&](std::span<const FacetKey<3>> shared) {
    if (shared.size() == 1) return;
    if (shared.size() > 2) {
      throw Error(ErrorCode::invalid_domain, "tetrahedra " + name_sources(mesh, shared) +
                                                 " share one facet: at most two can, remove the others");
    }
    if (same_side(mesh, same, shared)) {
      throw Error(ErrorCode::invalid_domain,
                  "tetrahedra " + name_sources(mesh, shared) +
                      " overlap: they lie on the same side of the facet they share");
    }
    mesh.facet[shared[0].slot] = {Border::Kind::interior, shared[1].slot / 4};
    mesh.facet[shared[1].slot] = {Border::Kind::interior, shared[0].slot / 4};
  });
  for (Border& border : mesh.facet) {
    if (border.kind == Border::Kind::boundary) border.index = mesh.boundary_count++;
  }
}

}  // namespace

RegionMeshPtr build_volume(std::span<const double> vertices, std::span<const std::uint32_t> tetrahedra) {
  check_simplices(vertices, tetrahedra, 4, "tetrahedron", "tetrahedra");
  auto mesh = std::make_shared<RegionMesh>();
  mesh->kind = DomainKind::volume;
  mesh->shape = RegionShape::tetrahedron;
  mesh->dimension = mesh->cell_dimension = 3;
  mesh->vertices.assign(vertices.begin(), vertices.end());
  mesh->region_vertex.reserve(tetrahedra.size());

  CompensatedSum<long double> volume;
  for (std::size_t k = 0; k < tetrahedra.size(); k += 4) {
    std::array<std::uint32_t, 4> corner;
    std::array<const double*, 4> at;
    for (std::size_t c = 0; c < 4; ++c) {
      corner[c] = tetrahedra[k + c];
      at[c] = &vertices[3 * std::size_t{corner[c]}];
    }
    const long double six_volumes = determinant(at);
    if (six_volumes == 0) continue;
    if (six_volumes < 0) std::swap(corner[2], corner[3]);
    volume.add(std::fabs(six_volumes) / 6);
    mesh->region_vertex.insert(mesh->region_vertex.end(), corner.begin(), corner.end());
    mesh->source.push_back(static_cast<std::uint32_t>(k / 4));
  }
  if (mesh->source.empty()) {
    throw Error(ErrorCode::invalid_domain,
                "the domain is empty: all " + std::to_string(tetrahedra.size() / 4) + " tetrahedra are flat");
  }
  for (std::uint32_t r = 0; r <= mesh->source.size(); ++r) mesh->region_offset.push_back(4 * r);
  mesh->facet_offset = mesh->region_offset;
  connect(*mesh);
  finish(*mesh, volume);
  return mesh;
}

}  // namespace powercell
