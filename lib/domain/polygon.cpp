#include <algorithm>

#include "lib/domain/adjacency.hpp"
#include "lib/domain/build.hpp"
#include "lib/domain/convex_pieces.hpp"
#include "lib/domain/measure.hpp"
#include "lib/domain/polygon_check.hpp"
#include "lib/domain/rings.hpp"

namespace powercell {
namespace {

/// Index of the first ring of each part, then the number of rings.
std::vector<std::size_t> first_rings(const IndexedRings& rings) {
  std::vector<std::size_t> first;
  for (std::size_t r = 0; r < rings.rings.size(); ++r) {
    if (rings.rings[r].hole == 0) first.push_back(r);
  }
  first.push_back(rings.rings.size());
  return first;
}

/// Fills in the borders of all edges. Edges of two pieces are interior; the others bound the domain and are
/// numbered in the order of the rings.
void connect(RegionMesh& mesh, const IndexedRings& rings) {
  std::vector<std::uint32_t> region(mesh.region_vertex.size()), next(mesh.region_vertex.size());
  std::vector<FacetKey<2>> keys(mesh.region_vertex.size()), open;
  for (std::uint32_t r = 0; r < mesh.region_count(); ++r) {
    for (std::uint32_t slot = mesh.region_offset[r]; slot < mesh.region_offset[r + 1]; ++slot) {
      const bool wraps = slot + 1 == mesh.region_offset[r + 1];
      next[slot] = mesh.region_vertex[wraps ? mesh.region_offset[r] : slot + 1];
      region[slot] = r;
      const auto [a, b] = std::minmax(mesh.region_vertex[slot], next[slot]);
      keys[slot] = {{a, b}, slot};
    }
  }
  mesh.facet.assign(keys.size(), {Border::Kind::boundary, 0});
  for_each_shared(keys, [&](std::span<const FacetKey<2>> shared) {
    const std::uint32_t slot = shared[0].slot;
    if (shared.size() == 1) {
      open.push_back({{mesh.region_vertex[slot], next[slot]}, slot});
    } else if (shared.size() == 2 && mesh.region_vertex[shared[1].slot] != mesh.region_vertex[slot]) {
      mesh.facet[slot] = {Border::Kind::interior, region[shared[1].slot]};
      mesh.facet[shared[1].slot] = {Border::Kind::interior, region[slot]};
    } else {
      const double* at = rings.at(mesh.region_vertex[slot]);
      throw Error(ErrorCode::invalid_domain, "parts overlap along the edge from " + place(at[0], at[1]));
    }
  });
  std::ranges::sort(open);
  for (const IndexedRing& ring : rings.rings) {
    for (std::size_t k = 0; k < ring.vertex.size(); ++k) {
      const FacetKey<2> edge{{ring.vertex[k], ring.vertex[(k + 1) % ring.vertex.size()]}, 0};
      const auto found = std::ranges::lower_bound(open, edge);
      if (found != open.end() && found->vertex == edge.vertex) {
        mesh.facet[found->slot].index = mesh.boundary_count++;
      }
    }
  }
}

/// Twice the area of a piece, from differences from its first vertex.
long double twice_area(const IndexedRings& rings, std::span<const std::uint32_t> piece) {
  const double* o = rings.at(piece[0]);
  long double sum = 0;
  for (std::size_t k = 2; k < piece.size(); ++k) {
    const double *a = rings.at(piece[k - 1]), *b = rings.at(piece[k]);
    sum += (static_cast<long double>(a[0]) - o[0]) * (static_cast<long double>(b[1]) - o[1]) -
           (static_cast<long double>(a[1]) - o[1]) * (static_cast<long double>(b[0]) - o[0]);
  }
  return sum;
}

}  // namespace

RegionMeshPtr build_polygon(std::span<const PolygonPart> parts) {
  IndexedRings rings = index_rings(parts);
  split_touched_edges(rings, check_polygon(rings));
  const std::vector<std::size_t> first = first_rings(rings);

  auto mesh = std::make_shared<RegionMesh>();
  mesh->kind = DomainKind::polygon;
  mesh->shape = RegionShape::polygon;
  mesh->dimension = mesh->cell_dimension = 2;
  Pieces pieces;
  for (std::uint32_t p = 0; p < rings.parts; ++p) {
    append_convex_pieces(rings, rings.part(first[p], first[p + 1]), pieces);
    mesh->source.resize(pieces.offset.size() - 1, p);
  }
  CompensatedSum<long double> area;
  for (std::size_t r = 0; r + 1 < pieces.offset.size(); ++r) {
    const std::uint32_t begin = pieces.offset[r], end = pieces.offset[r + 1];
    area.add(twice_area(rings, std::span(pieces.vertex).subspan(begin, end - begin)) / 2);
  }
  mesh->region_offset = mesh->facet_offset = std::move(pieces.offset);
  mesh->region_vertex = std::move(pieces.vertex);
  connect(*mesh, rings);
  mesh->vertices = std::move(rings.vertices);
  finish(*mesh, area);
  return mesh;
}

}  // namespace powercell
