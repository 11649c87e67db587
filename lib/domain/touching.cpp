#include "lib/domain/touching.hpp"

#include <algorithm>
#include <cmath>

#include "lib/domain/orientation.hpp"

namespace powercell {

void split_touched_edges(geos::Context& geos, IndexedRings& rings) {
  if (rings.rings.size() < 2) return;
  geos::Tree vertices(geos);
  for (std::uint32_t v = 0; v < rings.vertex_count(); ++v) {
    vertices.insert(geos.segment(rings.at(v), rings.at(v)), v);
  }
  std::vector<std::uint32_t> on_edge, ring_with_all;
  for (IndexedRing& ring : rings.rings) {
    ring_with_all.clear();
    for (std::size_t k = 0; k < ring.vertex.size(); ++k) {
      const std::uint32_t a = ring.vertex[k], b = ring.vertex[(k + 1) % ring.vertex.size()];
      on_edge.clear();
      vertices.query(geos.segment(rings.at(a), rings.at(b)), [&](std::size_t v) {
        const auto vertex = static_cast<std::uint32_t>(v);
        if (strictly_between(rings.at(a), rings.at(vertex), rings.at(b))) on_edge.push_back(vertex);
      });
      std::ranges::sort(on_edge);  // vertices are in lexicographic order, so also along the edge
      if (b < a) std::ranges::reverse(on_edge);
      ring_with_all.push_back(a);
      ring_with_all.insert(ring_with_all.end(), on_edge.begin(), on_edge.end());
    }
    ring.vertex = ring_with_all;
  }
}

void check_disjoint(geos::Context& geos, const std::vector<geos::Geometry>& polygons) {
  if (polygons.size() < 2 || !geos.defect(geos.multipolygon(polygons))) return;
  // A multipolygon must not have shared edges, which are legal here, so test the interiors of each pair.
  geos::Tree parts(geos);
  for (std::size_t p = 0; p < polygons.size(); ++p) parts.insert(polygons[p], p);
  std::vector<std::size_t> near;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    near.clear();
    parts.query(polygons[p], [&](std::size_t q) {
      if (q > p) near.push_back(q);
    });
    std::ranges::sort(near);
    for (std::size_t q : near) {
      if (const auto common = geos.overlap(polygons[p], polygons[q])) {
        throw Error(ErrorCode::invalid_domain, "parts " + std::to_string(p) + " and " + std::to_string(q) +
                                                   " " + *common +
                                                   "; parts may touch but not overlap: unite them first");
      }
    }
  }
}

}  // namespace powercell
