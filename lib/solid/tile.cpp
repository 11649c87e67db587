#include "lib/solid/tile.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace powercell::solid {
namespace {

/// The edges that are left when those in opposite directions cancel.
std::vector<DirectedEdge> without_opposite(std::vector<DirectedEdge> edges) {
  const auto low = [](const DirectedEdge& e) { return std::min(e.from, e.to); };
  const auto high = [](const DirectedEdge& e) { return std::max(e.from, e.to); };
  std::sort(edges.begin(), edges.end(), [&](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tuple(low(a), high(a), a.from) < std::tuple(low(b), high(b), b.from);
  });
  std::vector<DirectedEdge> left;
  for (std::size_t first = 0, last; first < edges.size(); first = last) {
    std::size_t up = 0;
    for (last = first; last < edges.size() && low(edges[last]) == low(edges[first]) &&
                       high(edges[last]) == high(edges[first]);
         ++last)
      up += edges[last].from < edges[last].to;
    const std::size_t down = last - first - up;
    for (std::size_t k = down; k < up; ++k) left.push_back(edges[first]);
    for (std::size_t k = up; k < down; ++k) left.push_back(edges[last - 1]);
  }
  return left;
}

/// The loops that edges between the vertices 0 .. count-1 form, none of which passes a vertex twice. Loops of
/// two edges are left out.
Polygons simple_loops(std::span<const DirectedEdge> edges, std::size_t count) {
  std::vector<std::vector<std::uint32_t>> to(count);
  for (const DirectedEdge& edge : edges) to[edge.from].push_back(edge.to);
  std::vector<std::uint32_t> path;
  std::vector<bool> on_path(count);
  Polygons loops;
  for (std::uint32_t start = 0; start < count; ++start) {
    for (std::uint32_t v = start; !to[start].empty() || v != start;) {
      path.push_back(v);
      on_path[v] = true;
      const std::uint32_t next = to[v].back();
      to[v].pop_back();
      v = next;
      if (!on_path[v]) continue;
      const auto first = std::find(path.begin(), path.end(), v);
      if (path.end() - first > 2) {
        loops.vertex.insert(loops.vertex.end(), first, path.end());
        loops.end.push_back(loops.vertex.size());
      }
      for (auto k = first; k != path.end(); ++k) on_path[*k] = false;
      path.erase(first, path.end());
    }
  }
  return loops;
}

}  // namespace

Polygons tile(std::vector<DirectedEdge> edges, std::span<const Vector3<double>> position,
              const Vector3<double>& normal) {
  std::erase_if(edges, [](const DirectedEdge& edge) { return edge.from == edge.to; });
  edges = without_opposite(std::move(edges));
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
  std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(x, y);
  std::vector<std::uint32_t> distinct;
  for (const DirectedEdge& edge : edges) distinct.push_back(edge.from);
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<std::array<double, 2>> flat;
  for (const std::uint32_t v : distinct) flat.push_back({position[v][x], position[v][y]});
  const auto local = [&](std::uint32_t v) {
    return static_cast<std::uint32_t>(std::lower_bound(distinct.begin(), distinct.end(), v) -
                                      distinct.begin());
  };
  for (DirectedEdge& edge : edges) edge = {local(edge.from), local(edge.to)};
  Polygons parts;
  append_convex_parts(simple_loops(edges, distinct.size()), flat, parts);
  for (std::uint32_t& v : parts.vertex) v = distinct[v];
  return parts;
}

}  // namespace powercell::solid
