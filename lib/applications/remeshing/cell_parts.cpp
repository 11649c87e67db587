#include "lib/applications/remeshing/cell_parts.hpp"

#include <algorithm>
#include <numeric>

namespace powercell::remeshing {
namespace {

bool has_edge(const Piece& piece, int k) {
  return std::any_of(piece.ring.begin(), piece.ring.end(), [&](const Corner& c) { return c.edge == ~k; });
}

/// Calls `found(p, q)` once for each pair of pieces of a cell that meet at an edge of the surface.
template <class Found>
void for_each_join(const LocalDiagram& diagram, const Found& found) {
  const Surface& surface = diagram.surface();
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t behind = surface.across[t][static_cast<std::size_t>(k)];
      if (behind == nothing || behind < t) continue;
      const auto& row = surface.triangle[t];
      const int back = surface.edge_towards(behind, row[static_cast<std::size_t>(k)],
                                            row[static_cast<std::size_t>((k + 1) % 3)]);
      for (const std::uint32_t p : diagram.pieces_in(t)) {
        if (!has_edge(diagram.piece(p), k)) continue;
        for (const std::uint32_t q : diagram.pieces_in(behind))
          if (diagram.piece(q).seed == diagram.piece(p).seed && has_edge(diagram.piece(q), back)) found(p, q);
      }
    }
}

struct Union {
  std::vector<std::uint32_t> parent;
  std::uint32_t root(std::uint32_t p) {
    while (parent[p] != p) p = parent[p] = parent[parent[p]];
    return p;
  }
  void join(std::uint32_t p, std::uint32_t q) { parent[root(p)] = root(q); }
};

/// The corner of the triangle at a vertex of a piece, or -1.
int corner_of_triangle(const Piece& piece, std::size_t v) {
  const int here = piece.ring[v].edge, before = piece.ring[v == 0 ? piece.ring.size() - 1 : v - 1].edge;
  return here < 0 && before < 0 && here != before ? ~here : -1;
}

}  // namespace

CellParts cell_parts(const LocalDiagram& diagram) {
  const Surface& surface = diagram.surface();
  std::uint32_t pieces = 0;
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (const std::uint32_t p : diagram.pieces_in(t)) pieces = std::max(pieces, p + 1);
  Union sets;
  sets.parent.resize(pieces);
  std::iota(sets.parent.begin(), sets.parent.end(), 0u);
  for_each_join(diagram, [&](std::uint32_t p, std::uint32_t q) { sets.join(p, q); });

  CellParts parts;
  parts.part.assign(pieces, nothing);
  for (std::uint32_t i = 0; i < diagram.size(); ++i)
    for (const std::uint32_t p : diagram.pieces(i)) {
      std::uint32_t& of_root = parts.part[sets.root(p)];
      if (of_root == nothing) {
        of_root = static_cast<std::uint32_t>(parts.seed.size());
        parts.seed.push_back(i);
      }
      parts.part[p] = of_root;
    }
  // Faces - inner edges + inner vertices, (63).
  parts.euler.assign(parts.seed.size(), 0);
  for (std::uint32_t i = 0; i < diagram.size(); ++i)
    for (const std::uint32_t p : diagram.pieces(i)) ++parts.euler[parts.part[p]];
  for_each_join(diagram, [&](std::uint32_t p, std::uint32_t) { --parts.euler[parts.part[p]]; });
  std::vector<std::uint32_t> around(surface.vertex.size(), 0), owner(surface.vertex.size(), nothing);
  std::vector<std::uint32_t> count(surface.vertex.size(), 0);
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++around[surface.triangle[t][k]];
      if (surface.across[t][k] == nothing)  // a vertex on the boundary is not inside a cell
        owner[surface.triangle[t][k]] = owner[surface.triangle[t][(k + 1) % 3]] = nothing - 1;
    }
    for (const std::uint32_t p : diagram.pieces_in(t)) {
      const Piece& piece = diagram.piece(p);
      for (std::size_t v = 0; v < piece.ring.size(); ++v) {
        const int k = corner_of_triangle(piece, v);
        if (k < 0) continue;
        const std::uint32_t vertex = surface.triangle[t][static_cast<std::size_t>(k)];
        if (owner[vertex] == nothing) owner[vertex] = parts.part[p];
        if (owner[vertex] == parts.part[p]) ++count[vertex];
      }
    }
  }
  for (std::size_t v = 0; v < surface.vertex.size(); ++v)
    if (around[v] > 0 && owner[v] < nothing - 1 && count[v] == around[v]) ++parts.euler[owner[v]];
  return parts;
}

}  // namespace powercell::remeshing
