#include "apps/io/picture/outline.hpp"

#include <algorithm>
#include <cstdint>
#include <powercell/regions.hpp>

namespace powercell::io {
namespace {

using Point = std::array<double, 2>;

struct Edge {
  Point from, to;
  bool used = false;
};

std::vector<Edge> boundary_edges(const RegionsView& mesh) {
  const auto point = [&](std::uint32_t v) {
    return Point{mesh.vertices[2 * std::size_t{v}], mesh.vertices[2 * std::size_t{v} + 1]};
  };
  std::vector<Edge> edges;
  for (std::size_t r = 0; r < mesh.size(); ++r) {
    const std::uint32_t first = mesh.region_offset[r], end = mesh.region_offset[r + 1];
    for (std::uint32_t k = first; k < end; ++k) {
      if (mesh.facet[mesh.facet_offset[r] + (k - first)].kind != Border::Kind::boundary) continue;
      const std::uint32_t next = k + 1 < end ? k + 1 : first;
      edges.push_back({point(mesh.region_vertex[k]), point(mesh.region_vertex[next])});
    }
  }
  return edges;
}

}  // namespace

// Edges have the domain on their left, so following edges from end to start gives the rings.
std::vector<Ring> boundary_rings(const Domain& domain) {
  std::vector<Edge> edges = boundary_edges(domain.regions());
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.from < b.from; });
  std::vector<Ring> rings;
  for (Edge& start : edges) {
    if (start.used) continue;
    Ring ring;
    for (Edge* edge = &start; edge;) {
      edge->used = true;
      ring.push_back(edge->from);
      auto next = std::lower_bound(edges.begin(), edges.end(), edge->to,
                                   [](const Edge& e, const Point& p) { return e.from < p; });
      while (next != edges.end() && next->from == edge->to && next->used) ++next;
      edge = next != edges.end() && next->from == edge->to ? &*next : nullptr;
    }
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace powercell::io
