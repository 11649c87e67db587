#include "lib/base/positions.hpp"
#include "lib/base/text.hpp"
#include "lib/domain/adjacency.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/measure.hpp"
#include "lib/domain/overlap.hpp"

namespace powercell {
namespace {

/// Signed volume of a tetrahedron, or 0 if it is flat.
long double signed_volume(const double* const* v) {
  const Vector a = difference<long double>(v[1], v[0]), b = difference<long double>(v[2], v[0]),
               c = difference<long double>(v[3], v[0]);
  const Vector ab = difference<long double>(v[2], v[1]), ac = difference<long double>(v[3], v[1]),
               bc = difference<long double>(v[3], v[2]);
  const Vector facet[4] = {cross(a, b), cross(b, c), cross(c, a), cross(ab, ac)};  // twice their areas
  const long double longest2 =
      std::max({dot(a, a), dot(b, b), dot(c, c), dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  const long double facet2 = std::max(
      {dot(facet[0], facet[0]), dot(facet[1], facet[1]), dot(facet[2], facet[2]), dot(facet[3], facet[3])});
  const long double six_volumes = dot(a, facet[1]);  // = least height times twice the largest facet
  const bool flat = std::fabs(six_volumes) <= flat_ratio * std::sqrt(longest2) * std::sqrt(facet2);
  return flat ? 0 : six_volumes / 6;
}

std::string name_sources(const RegionMesh& mesh, std::span<const FacetKey<3>> shared) {
  std::string names;
  for (std::size_t k = 0; k < shared.size(); ++k) {
    names += (k == 0 ? "" : k + 1 == shared.size() ? " and " : ", ");
    names += std::to_string(mesh.source[shared[k].slot / 4]);
  }
  return names;
}

/// Whether two regions lie on the same side of the facet that they share: their facets then have the same
/// orientation.
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

/// Fills in the borders of all facets. A facet of one tetrahedron bounds the volume.
/// \return repeated tetrahedra; if there are any, borders are incomplete
Repeated connect(RegionMesh& mesh, const std::vector<std::uint32_t>& same) {
  const auto apex = [&](std::uint32_t slot) { return same[mesh.region_vertex[slot]]; };
  Repeated repeated;
  std::vector<FacetKey<3>> facets(mesh.region_vertex.size());
  for (std::uint32_t slot = 0; slot < facets.size(); ++slot) {
    const std::uint32_t* region = &mesh.region_vertex[slot / 4 * 4];
    for (int c = 0; c < 3; ++c) facets[slot].vertex[c] = same[region[tetrahedron_facet[slot % 4][c]]];
    std::sort(facets[slot].vertex.begin(), facets[slot].vertex.end());
    facets[slot].slot = slot;
  }
  mesh.facet.assign(facets.size(), {Border::Kind::boundary, 0});
  for_each_shared(facets, [&](std::span<const FacetKey<3>> shared) {
    if (shared.size() == 1 || add_repeated(shared, mesh, apex, repeated)) return;
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
  number_boundary(mesh);
  return repeated;
}

void refuse_large_overlaps(const RegionMesh& mesh) {
  constexpr double most = 1e-6;  // of the volume
  const MeshReport& report = mesh.report;
  if (!(report.overlap > most * mesh.measure)) return;
  const Overlap& o = report.largest;
  const std::string others =
      report.overlaps > 1 ? ", as do " + std::to_string(report.overlaps - 1) + " other pairs" : "";
  throw Error(ErrorCode::invalid_domain,
              "tetrahedra " + std::to_string(o.first) + " and " + std::to_string(o.second) +
                  " overlap around " + place_text(o.at.data()) + others + ": " +
                  digits(report.overlap / mesh.measure, 2) +
                  " of the volume would count twice; separate the parts, or cut one out of the other");
}

}  // namespace

RegionMeshPtr build_volume(std::span<const double> vertices, std::span<const std::uint32_t> tetrahedra) {
  auto mesh = simplex_mesh(vertices, tetrahedra, 4, signed_volume);
  const std::vector<std::uint32_t> same = first_at_position(mesh->vertices, 3);
  if (Repeated repeated = distinct(connect(*mesh, same)); !repeated.empty()) {
    mesh = simplex_mesh(vertices, tetrahedra, 4, signed_volume, std::move(repeated));
    connect(*mesh, same);
  }
  find_overlapping_tetrahedra(*mesh);
  refuse_large_overlaps(*mesh);
  return mesh;
}

}  // namespace powercell
