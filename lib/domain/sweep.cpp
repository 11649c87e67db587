#include <algorithm>
#include <limits>
#include <set>

#include "lib/domain/orientation.hpp"
#include "lib/domain/triangulation.hpp"

namespace powercell {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The right border of the triangles so far, between two edges that the sweep line crosses: vertices from the
/// lower edge to the upper one, as nodes of a doubly linked list. No three consecutive ones form a triangle
/// that could still be cut off on the right.
struct Chain {
  std::uint32_t bottom = none, top = none;
  std::uint32_t latest = none;  ///< the vertex swept last: visible from the next one
};

/// A ring edge from its lexicographically lesser end to the greater.
struct Edge {
  std::uint32_t left, right;
  bool inside_above;  ///< the domain is above it
  Chain chain;        ///< of the gap above it, if that is inside
};

/// The sweep passes the vertices in lexicographic order, the order of their indices.
class Sweep {
 public:
  Sweep(const IndexedRings& vertices, std::span<const IndexedRing> rings)
      : at_(vertices), status_(Below{this}) {
    for (const IndexedRing& ring : rings) {
      for (std::size_t k = 0; k < ring.vertex.size(); ++k) {
        const std::uint32_t a = ring.vertex[k], b = ring.vertex[(k + 1) % ring.vertex.size()];
        edges_.push_back({std::min(a, b), std::max(a, b), a < b, {}});
      }
    }
    // Edges with the same left end are sorted from bottom to top.
    std::ranges::sort(edges_, [&](const Edge& e, const Edge& f) {
      return e.left != f.left ? e.left < f.left : turn(e.left, e.right, f.right) > 0;
    });
    place_.resize(edges_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) ending_.push_back({edges_[e].right, e});
    std::ranges::sort(ending_);
  }

  std::vector<std::uint32_t> run() {
    std::uint32_t start = 0, end = 0;
    const auto count = static_cast<std::uint32_t>(edges_.size());
    while (start < count || end < count) {
      const std::uint32_t v =
          start < count ? std::min(edges_[start].left, ending_[end].vertex) : ending_[end].vertex;
      const std::uint32_t first_start = start, first_end = end;
      while (start < count && edges_[start].left == v) ++start;
      while (end < count && ending_[end].vertex == v) ++end;
      if (!pass(v, first_end, end, first_start, start)) return {};
    }
    return std::move(triangles_);
  }

 private:
  struct Node {
    std::uint32_t vertex, down, up;
  };
  struct Ending {
    std::uint32_t vertex, edge;
    friend auto operator<=>(const Ending&, const Ending&) = default;
  };
  struct Point {
    std::uint32_t vertex;
  };
  /// The order of the edges that the sweep line crosses, from bottom to top, and of a point among them.
  struct Below {
    using is_transparent = void;
    const Sweep* sweep;
    bool operator()(std::uint32_t e, std::uint32_t f) const { return sweep->below(e, f); }
    bool operator()(std::uint32_t e, Point p) const { return sweep->turn_at(e, p.vertex) > 0; }
    bool operator()(Point p, std::uint32_t e) const { return sweep->turn_at(e, p.vertex) < 0; }
  };
  using Status = std::set<std::uint32_t, Below>;

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orient2d(at_.at(a), at_.at(b), at_.at(c));
  }
  int turn_at(std::uint32_t e, std::uint32_t v) const { return turn(edges_[e].left, edges_[e].right, v); }
  bool below(std::uint32_t e, std::uint32_t f) const {
    if (edges_[e].left > edges_[f].left) return turn_at(f, edges_[e].left) < 0;
    const int side = turn_at(e, edges_[f].left);
    return side != 0 ? side > 0 : turn_at(e, edges_[f].right) > 0;
  }

  std::uint32_t node(std::uint32_t vertex, std::uint32_t down, std::uint32_t up) {
    const auto n = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({vertex, down, up});
    if (down != none) nodes_[down].up = n;
    if (up != none) nodes_[up].down = n;
    return n;
  }

  /// If the triangle of v and the chain's edge from `down` to `up` is positive, cuts it off and returns true.
  bool cut(std::uint32_t v, std::uint32_t down, std::uint32_t up) {
    if (down == none || up == none || turn(v, nodes_[up].vertex, nodes_[down].vertex) <= 0) return false;
    triangles_.insert(triangles_.end(), {v, nodes_[up].vertex, nodes_[down].vertex});
    return true;
  }
  /// Cuts off the triangles of v and the edges visible from it, from node n downwards or upwards; returns the
  /// last visible node.
  std::uint32_t cut_down(std::uint32_t v, std::uint32_t n) {
    while (cut(v, nodes_[n].down, n)) n = nodes_[n].down;
    return n;
  }
  std::uint32_t cut_up(std::uint32_t v, std::uint32_t n) {
    while (cut(v, n, nodes_[n].up)) n = nodes_[n].up;
    return n;
  }

  /// Cuts off what v sees from node `from` downwards; v becomes the top of the chain.
  Chain end_chain(std::uint32_t v, const Chain& chain, std::uint32_t from) {
    const std::uint32_t last = cut_down(v, from), n = node(v, last, none);
    return {chain.bottom, n, n};
  }
  /// Cuts off what v sees from node `from` upwards; v becomes the bottom of the chain.
  Chain begin_chain(std::uint32_t v, const Chain& chain, std::uint32_t from) {
    const std::uint32_t last = cut_up(v, from), n = node(v, none, last);
    return {n, chain.top, n};
  }

  /// Moves the sweep line over v. False if the order of the edges shows that some cross.
  bool pass(std::uint32_t v, std::uint32_t end_first, std::uint32_t end_last, std::uint32_t start_first,
            std::uint32_t start_last) {
    Chain upper;  // of the gap above v
    typename Status::iterator above;
    if (end_first == end_last) {
      above = status_.upper_bound(Point{v});
      const std::uint32_t lower_edge = above == status_.begin() ? none : *std::prev(above);
      if (lower_edge != none && edges_[lower_edge].inside_above) upper = split(v, edges_[lower_edge].chain);
    } else if (!close(v, end_first, end_last, above, upper)) {
      return false;
    }
    const std::uint32_t lower_edge = above == status_.begin() ? none : *std::prev(above);
    for (std::uint32_t e = start_first; e < start_last; ++e) {
      const std::size_t before = status_.size();
      place_[e] = status_.insert(above, e);
      if (status_.size() == before) return false;  // it overlaps another one
      if (!edges_[e].inside_above) continue;
      if (e + 1 < start_last) {
        const std::uint32_t n = node(v, none, none);
        edges_[e].chain = {n, n, n};
      } else {
        edges_[e].chain = upper;
      }
    }
    const bool starts = start_first < start_last;
    const bool inside_below = lower_edge != none && edges_[lower_edge].inside_above;
    const bool inside_above = upper.bottom != none;
    if (starts)
      return inside_above == edges_[start_last - 1].inside_above &&
             inside_below != edges_[start_first].inside_above;
    if (inside_above != inside_below) return false;
    if (inside_above) edges_[lower_edge].chain = join(edges_[lower_edge].chain, upper);
    return true;
  }

  /// Splits the chain of the gap in which v lies into two, both with v; returns the upper one.
  Chain split(std::uint32_t v, Chain& lower) {
    const Chain whole = lower;
    const std::uint32_t up = nodes_[whole.latest].up;
    const std::uint32_t latest_again = node(nodes_[whole.latest].vertex, none, up);
    nodes_[whole.latest].up = none;
    Chain upper{latest_again, up == none ? latest_again : whole.top, latest_again};
    lower = end_chain(v, {whole.bottom, none, none}, whole.latest);
    return begin_chain(v, upper, latest_again);
  }

  /// Removes the edges that end at v from the status; `upper` becomes the chain above the topmost, if the
  /// domain is there. False if these edges are not consecutive or a gap between two of them is not filled.
  bool close(std::uint32_t v, std::uint32_t end_first, std::uint32_t end_last, Status::iterator& above,
             Chain& upper) {
    auto first = place_[ending_[end_first].edge];
    while (first != status_.begin() && edges_[*std::prev(first)].right == v) --first;
    const std::uint32_t lower_edge = first == status_.begin() ? none : *std::prev(first);
    if (lower_edge != none && edges_[lower_edge].inside_above) {
      Chain& chain = edges_[lower_edge].chain;
      chain = end_chain(v, chain, chain.top);
    }
    std::uint32_t count = 0;
    above = first;
    while (above != status_.end() && edges_[*above].right == v) {
      const Edge& edge = edges_[*above];
      above = status_.erase(above);
      ++count;
      if (!edge.inside_above) continue;
      const bool closed = above != status_.end() && edges_[*above].right == v;
      if (!closed) {
        upper = begin_chain(v, edge.chain, edge.chain.bottom);
      } else if (cut_up(v, edge.chain.bottom) != edge.chain.top) {
        return false;
      }
    }
    return count == end_last - end_first;
  }

  /// Joins two chains that meet in v.
  Chain join(const Chain& lower, const Chain& upper) {
    const std::uint32_t next = nodes_[upper.bottom].up;
    nodes_[lower.top].up = next;
    if (next != none) nodes_[next].down = lower.top;
    return {lower.bottom, next == none ? lower.top : upper.top, lower.top};
  }

  const IndexedRings& at_;
  std::vector<Edge> edges_;
  std::vector<Ending> ending_;  // edges by right end
  Status status_;
  std::vector<Status::iterator> place_;  // per edge, while in the status
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

std::vector<std::uint32_t> sweep_triangulate(const IndexedRings& vertices,
                                             std::span<const IndexedRing> rings) {
  return Sweep(vertices, rings).run();
}

}  // namespace powercell
