#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/collect/join_faces.hpp"

namespace powercell {
namespace {

struct RingEdge {
  std::uint32_t from, to;
  Border border;
  bool used = false;
};

/// Walks along the directed edges of a planar cell, with the cell on the left.
class RingWalk {
 public:
  RingWalk(const CellWeld& weld, JoinedFaces& faces) : weld_(weld), faces_(faces) {
    for (std::size_t f = 0; f < weld.face_count(); ++f) {
      if (weld.removed(f)) continue;
      const std::uint32_t a = weld.same(weld.face(f)[0]), b = weld.same(weld.face(f)[1]);
      if (a != b) edges_.push_back({a, b, weld.border(f)});
    }
    std::stable_sort(edges_.begin(), edges_.end(),
                     [](const RingEdge& a, const RingEdge& b) { return a.from < b.from; });
    at_.assign(weld.vertex_count(), none);
  }

  void walk() {
    for (RingEdge& start : edges_) {
      if (start.used) continue;
      for (RingEdge* edge = &start; edge; edge = next(*edge)) {
        edge->used = true;
        at_[edge->from] = static_cast<std::uint32_t>(path_.size());
        path_.push_back(edge);
        if (at_[edge->to] == none) continue;
        close_ring(at_[edge->to]);  // the rest of the path ends at the same vertex
        if (path_.empty()) break;
      }
    }
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  /// The angle from the reversed direction of `in` clockwise to the direction of `out`, in (0, 2 pi].
  double clockwise(const RingEdge& in, const RingEdge& out) const {
    const double *a = weld_.position(in.from), *v = weld_.position(in.to), *b = weld_.position(out.to);
    const double back[2] = {a[0] - v[0], a[1] - v[1]}, on[2] = {b[0] - v[0], b[1] - v[1]};
    const double angle = std::atan2(on[0] * back[1] - on[1] * back[0], on[0] * back[0] + on[1] * back[1]);
    return angle > 0 ? angle : angle + 2 * std::numbers::pi;
  }

  /// The next edge along the same part of the cell. As many edges start at a vertex as end there, so one
  /// exists.
  RingEdge* next(const RingEdge& in) {
    auto out = std::lower_bound(edges_.begin(), edges_.end(), in.to,
                                [](const RingEdge& e, std::uint32_t v) { return e.from < v; });
    RingEdge* best = nullptr;
    for (; out != edges_.end() && out->from == in.to; ++out) {
      if (out->used) continue;
      if (!best || clockwise(in, *out) < clockwise(in, *best)) best = &*out;
    }
    return best;
  }

  void close_ring(std::size_t begin) {
    const std::size_t n = path_.size() - begin;
    const auto edge = [&](std::size_t k) -> const RingEdge& { return *path_[begin + k % n]; };
    const auto stays = [&](std::size_t k) {
      return !weld_.on_interior(edge(k).from) || !(edge(k).border == edge(k + n - 1).border);
    };
    std::size_t corners = 0;
    for (std::size_t k = 0; k < n; ++k) corners += stays(k);
    // An edge starts at a corner and includes the following ones, which have the same border.
    for (std::size_t k = 0; n > 2 && k < n; ++k) {
      if (corners > 2 && !stays(k)) continue;
      faces_.loop.push_back(edge(k).from);
      faces_.edge_border.push_back(edge(k).border);
    }
    if (n > 2) faces_.end.push_back(faces_.loop.size());
    for (std::size_t k = 0; k < n; ++k) at_[edge(k).from] = none;
    path_.resize(begin);
  }

  const CellWeld& weld_;
  JoinedFaces& faces_;
  std::vector<RingEdge> edges_;        // by start
  std::vector<const RingEdge*> path_;  // passes no vertex twice
  std::vector<std::uint32_t> at_;      // by vertex: the place in path_ of the edge that starts there
};

}  // namespace

void JoinedFaces::clear() {
  loop.clear();
  end.clear();
  face_border.clear();
  edge_border.clear();
}

void join_rings(const CellWeld& weld, JoinedFaces& faces) {
  RingWalk(weld, faces).walk();
}

void join_triangles(const CellWeld& weld, JoinedFaces& faces) {
  for (std::size_t p = 0; p < weld.piece_count(); ++p) {
    const std::size_t begin = faces.loop.size();
    for (std::size_t f = weld.piece(p); f < weld.piece(p + 1); ++f) {
      const std::uint32_t a = weld.same(weld.face(f)[0]), b = weld.same(weld.face(f)[1]);
      if (a == b) continue;
      faces.loop.push_back(a);
      faces.edge_border.push_back(weld.border(f));
    }
    if (faces.loop.size() - begin > 2) {
      faces.end.push_back(faces.loop.size());
    } else {
      faces.loop.resize(begin);
      faces.edge_border.resize(begin, {Border::Kind::wall, 0});
    }
  }
}

}  // namespace powercell
