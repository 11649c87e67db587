// Triangles that have no area by their corners alone, or are given twice.
#include <algorithm>
#include <numeric>

#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/repair_steps.hpp"
#include "lib/base/disjoint_sets.hpp"

namespace powercell::remeshing {
namespace {

using Corners = std::array<std::uint32_t, 3>;

Corners sorted(Corners row) {
  std::sort(row.begin(), row.end());
  return row;
}

/// For each triangle the first one with the same key, in any order of its corners.
template <class Key>
std::vector<std::uint32_t> first_with_same(std::size_t count, const Key& key) {
  std::vector<std::uint32_t> order(count), first(count);
  std::iota(order.begin(), order.end(), 0u);
  std::vector<Corners> keys(count);
  for (std::uint32_t t = 0; t < count; ++t) keys[t] = sorted(key(t));
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return keys[a] != keys[b] ? keys[a] < keys[b] : a < b; });
  for (std::size_t k = 0; k < count; ++k)
    first[order[k]] = k > 0 && keys[order[k]] == keys[order[k - 1]] ? first[order[k - 1]] : order[k];
  return first;
}

/// Parts of a mesh that are connected by edges with the same two vertices.
DisjointSets parts_by_edges(const Rows& row) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> edges;
  for (std::uint32_t t = 0; t < row.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(row[t][k], row[t][(k + 1) % 3]);
      edges.emplace_back(edge_key(a, b), t);
    }
  std::sort(edges.begin(), edges.end());
  DisjointSets parts(row.size());
  for (std::size_t k = 1; k < edges.size(); ++k)
    if (edges[k].first == edges[k - 1].first) parts.unite(edges[k].second, edges[k - 1].second);
  return parts;
}

/// Keeps the triangles that are not marked, and counts the others.
void drop(Patchwork& mesh, const std::vector<bool>& marked, RepairCount& what) {
  Rows kept;
  for (std::size_t t = 0; t < mesh.row.size(); ++t) {
    if (!marked[t])
      kept.push_back(mesh.row[t]);
    else
      count(what, mesh.vertex[mesh.row[t][0]]);
  }
  mesh.row = std::move(kept);
}

}  // namespace

void drop_doubles(Patchwork& mesh, std::span<const std::uint32_t> same, RepairReport& report) {
  const auto place = [&](std::uint32_t t) -> Corners {
    return {same[mesh.row[t][0]], same[mesh.row[t][1]], same[mesh.row[t][2]]};
  };
  std::vector<bool> marked(mesh.row.size());
  for (std::uint32_t t = 0; t < mesh.row.size(); ++t) {
    const Corners at = place(t);
    marked[t] = at[0] == at[1] || at[1] == at[2] || at[2] == at[0];
  }
  drop(mesh, marked, report.degenerate);

  std::vector<std::uint32_t> first =
      first_with_same(mesh.row.size(), [&](std::uint32_t t) { return mesh.row[t]; });
  marked.assign(mesh.row.size(), false);
  for (std::uint32_t t = 0; t < mesh.row.size(); ++t) marked[t] = first[t] != t;
  drop(mesh, marked, report.repeated);

  // With vertices of its own a triangle at the same place may be part of a solid that touches another one: it
  // is only dropped with all of its part.
  first = first_with_same(mesh.row.size(), place);
  DisjointSets parts = parts_by_edges(mesh.row);
  std::vector<bool> needed(mesh.row.size(), false);
  for (std::uint32_t t = 0; t < mesh.row.size(); ++t)
    if (first[t] == t) needed[parts.root(t)] = true;
  marked.assign(mesh.row.size(), false);
  for (std::uint32_t t = 0; t < mesh.row.size(); ++t) marked[t] = !needed[parts.root(t)];
  drop(mesh, marked, report.repeated);
}

}  // namespace powercell::remeshing
