#include "lib/domain/convex_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/domain/orientation.hpp"
#include "lib/domain/triangulation.hpp"

namespace powercell {
namespace {

/// Whether the ring has no right turn and, if `strict`, no straight vertex. (Rings are simple, so this is
/// convexity.)
bool is_convex(const IndexedRings& rings, const std::vector<std::uint32_t>& ring, bool strict) {
  for (std::size_t k = 0, n = ring.size(); k < n; ++k) {
    const int turn = orient2d(rings.at(ring[k]), rings.at(ring[(k + 1) % n]), rings.at(ring[(k + 2) % n]));
    if (turn < (strict ? 1 : 0)) return false;
  }
  return true;
}

void append(Pieces& pieces, std::span<const std::uint32_t> piece) {
  pieces.vertex.insert(pieces.vertex.end(), piece.begin(), piece.end());
  pieces.offset.push_back(static_cast<std::uint32_t>(pieces.vertex.size()));
}

/// Halves a strictly convex polygon by chords until the pieces are small enough.
void append_halves(Pieces& pieces, std::span<const std::uint32_t> ring) {
  if (ring.size() <= piece_capacity) return append(pieces, ring);
  const std::size_t middle = ring.size() / 2;
  append_halves(pieces, ring.first(middle + 1));
  std::vector<std::uint32_t> rest(ring.begin() + static_cast<std::ptrdiff_t>(middle), ring.end());
  rest.push_back(ring[0]);
  append_halves(pieces, rest);
}

/// Hertel and Mehlhorn: removes diagonals, longest first, if both ends stay convex and the merged piece is
/// small enough. Apart from the capacity, the number of pieces is at most four times the least possible.
class Merge {
 public:
  Merge(const IndexedRings& rings, const Triangulation& mesh) : rings_(rings), mesh_(mesh) {
    const auto edges = static_cast<std::uint32_t>(mesh.corner.size());
    next_.resize(edges);
    before_.resize(edges);
    for (std::uint32_t h = 0; h < edges; ++h) {
      next_[h] = h % 3 == 2 ? h - 2 : h + 1;
      before_[next_[h]] = h;
    }
    size_.assign(edges / 3, 3);
    parent_.resize(edges / 3);
    std::iota(parent_.begin(), parent_.end(), 0u);
    gone_.assign(edges, false);
  }

  void append_to(Pieces& pieces) {
    for (std::uint32_t h : diagonals()) {
      if (removable(h)) remove(h);
    }
    std::vector<bool> seen(next_.size(), false);
    std::vector<std::uint32_t> piece;
    for (std::uint32_t start = 0; start < next_.size(); ++start) {
      if (gone_[start] || seen[start]) continue;
      piece.clear();
      for (std::uint32_t h = start; !seen[h]; h = next_[h]) {
        seen[h] = true;
        piece.push_back(mesh_.corner[h]);
      }
      append(pieces, piece);
    }
  }

 private:
  const double* from(std::uint32_t h) const { return rings_.at(mesh_.corner[h]); }

  std::vector<std::uint32_t> diagonals() const {
    std::vector<std::pair<double, std::uint32_t>> by_length;
    for (std::uint32_t h = 0; h < next_.size(); ++h) {
      if (mesh_.twin[h] == no_twin || mesh_.twin[h] < h) continue;
      const double *a = from(h), *b = from(next_[h]);
      by_length.emplace_back(-std::hypot(b[0] - a[0], b[1] - a[1]), h);
    }
    std::ranges::sort(by_length);
    std::vector<std::uint32_t> order;
    for (const auto& [length, h] : by_length) order.push_back(h);
    return order;
  }

  std::uint32_t piece_of(std::uint32_t h) {
    std::uint32_t t = h / 3;
    while (parent_[t] != t) t = parent_[t] = parent_[parent_[t]];
    return t;
  }

  /// Whether the corner between the half-edges `in` and `out` is convex once they are consecutive.
  bool convex_after(std::uint32_t in, std::uint32_t out) const {
    const double *a = from(in), *v = from(out), *b = from(next_[out]);
    return orient2d(a, v, b) > 0 || strictly_between(a, v, b);
  }

  bool removable(std::uint32_t h) {
    const std::uint32_t t = mesh_.twin[h], p = piece_of(h), q = piece_of(t);
    return p != q && size_[p] + size_[q] - 2 <= piece_capacity && convex_after(before_[h], next_[t]) &&
           convex_after(before_[t], next_[h]);
  }

  void remove(std::uint32_t h) {
    const std::uint32_t t = mesh_.twin[h], p = piece_of(h), q = piece_of(t);
    auto connect = [&](std::uint32_t in, std::uint32_t out) {
      next_[in] = out;
      before_[out] = in;
    };
    connect(before_[h], next_[t]);
    connect(before_[t], next_[h]);
    gone_[h] = gone_[t] = true;
    size_[p] += size_[q] - 2;
    parent_[q] = p;
  }

  const IndexedRings& rings_;
  const Triangulation& mesh_;
  std::vector<std::uint32_t> next_, before_, size_, parent_;
  std::vector<bool> gone_;
};

}  // namespace

void append_convex_pieces(const IndexedRings& vertices, std::span<const IndexedRing> rings, Pieces& pieces) {
  const auto& outer = rings[0].vertex;
  const bool no_holes = rings.size() == 1;
  if (no_holes && outer.size() <= piece_capacity && is_convex(vertices, outer, false))
    return append(pieces, outer);
  if (no_holes && is_convex(vertices, outer, true)) return append_halves(pieces, outer);
  const Triangulation mesh = triangulate(vertices, rings);
  Merge(vertices, mesh).append_to(pieces);
}

}  // namespace powercell
