#include "lib/applications/remeshing/mesh_check.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <utility>

#include "lib/base/mesh_arrays.hpp"

namespace powercell::remeshing {
namespace {

/// Checks that the triangles of each vertex form one fan by walking around the vertex. A closed fan of fewer
/// than three triangles is degenerate: two triangles with the same corners.
void find_fans(std::span<const std::array<std::uint32_t, 3>> triangles, MeshCheck& check) {
  // A triangle at vertex v: the fan goes on from its next corner to the one after.
  struct Step {
    std::uint32_t v, from, to;
    auto operator<=>(const Step&) const = default;
  };
  std::vector<Step> steps;
  for (const auto& row : triangles)
    for (std::size_t k = 0; k < 3; ++k) steps.push_back({row[k], row[(k + 1) % 3], row[(k + 2) % 3]});
  std::sort(steps.begin(), steps.end());
  for (std::size_t begin = 0; begin < steps.size();) {
    std::size_t end = begin;
    while (end < steps.size() && steps[end].v == steps[begin].v) ++end;
    const auto first = steps.begin() + static_cast<std::ptrdiff_t>(begin),
               last = steps.begin() + static_cast<std::ptrdiff_t>(end);
    const auto find = [&](std::uint32_t from) {
      const auto at =
          std::lower_bound(first, last, from, [](const Step& s, std::uint32_t x) { return s.from < x; });
      return at != last && at->from == from ? at : last;
    };
    // An open fan starts at the corner that no triangle leads to.
    std::vector<std::uint32_t> led_to;
    std::transform(first, last, std::back_inserter(led_to), [](const Step& s) { return s.to; });
    std::sort(led_to.begin(), led_to.end());
    auto start = first;
    for (auto at = first; at != last; ++at)
      if (!std::binary_search(led_to.begin(), led_to.end(), at->from)) start = at;
    std::size_t walked = 0;
    bool closed = false;
    for (auto at = start; at != last && walked <= end - begin;) {
      ++walked;
      at = find(at->to);
      closed = at == start;
      if (closed) break;
    }
    if (walked != end - begin || (closed && walked < 3)) check.not_manifold.push_back(steps[begin].v);
    begin = end;
  }
}

}  // namespace

void check_triangles(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  check_simplices(vertices, triangles, 3, "triangle", "triangles");
  double largest = 0;
  for (const std::uint32_t v : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      largest = std::max(largest, std::fabs(vertices[3 * std::size_t{v} + k]));
  check_magnitude(largest);
}

bool MeshCheck::has_edge(std::uint32_t from, std::uint32_t to) const {
  return std::binary_search(edges.begin(), edges.end(), edge_key(from, to));
}

MeshCheck check_mesh(std::span<const std::array<std::uint32_t, 3>> triangles, std::size_t vertices) {
  MeshCheck check;
  check.used.assign(vertices, false);
  for (const auto& row : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      check.used[row[k]] = true;
      check.edges.push_back(edge_key(row[k], row[(k + 1) % 3]));
      if (row[k] == row[(k + 1) % 3]) check.not_manifold.push_back(row[k]);
    }
  std::sort(check.edges.begin(), check.edges.end());
  long twice_edges = 0;
  std::unordered_map<std::uint32_t, std::uint32_t> next;
  for (std::size_t k = 0; k < check.edges.size(); ++k) {
    const auto from = static_cast<std::uint32_t>(check.edges[k] >> 32),
               to = static_cast<std::uint32_t>(check.edges[k]);
    if (k > 0 && check.edges[k] == check.edges[k - 1])
      check.not_manifold.insert(check.not_manifold.end(), {from, to});
    const bool shared = check.has_edge(to, from);
    twice_edges += shared ? 1 : 2;
    if (shared) continue;
    check.boundary_edges.emplace_back(from, to);
    next[from] = to;
  }
  while (!next.empty()) {
    ++check.loops;
    for (auto at = next.begin(); at != next.end();) {
      const std::uint32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  const long used = std::count(check.used.begin(), check.used.end(), true);
  check.euler = static_cast<int>(used - twice_edges / 2 + static_cast<long>(triangles.size()));
  find_fans(triangles, check);
  return check;
}

}  // namespace powercell::remeshing
