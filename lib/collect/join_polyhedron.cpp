#include <algorithm>
#include <array>
#include <tuple>

#include "lib/collect/join_faces.hpp"

namespace powercell {
namespace {

struct Polygon {
  std::vector<std::uint32_t> loop;
  Border border;
};

struct Edge {
  std::uint32_t from, to, polygon;
};

bool same_ends(const Edge& a, const Edge& b) {
  return std::minmax(a.from, a.to) == std::minmax(b.from, b.to);
}

std::vector<Polygon> faces_left(const CellWeld& weld) {
  std::vector<Polygon> polygons;
  for (std::size_t f = 0; f < weld.face_count(); ++f) {
    if (weld.removed(f)) continue;
    Polygon polygon{{}, weld.border(f)};
    for (const std::uint32_t v : weld.face(f))
      if (polygon.loop.empty() || polygon.loop.back() != weld.same(v)) polygon.loop.push_back(weld.same(v));
    while (polygon.loop.size() > 1 && polygon.loop.front() == polygon.loop.back()) polygon.loop.pop_back();
    if (polygon.loop.size() > 2) polygons.push_back(std::move(polygon));
  }
  return polygons;
}

/// The ring that the edges form; empty if they form several rings, or one that touches itself in a vertex.
std::vector<std::uint32_t> single_ring(std::vector<Edge>& edges) {
  const auto by_start = [](const Edge& a, const Edge& b) { return a.from < b.from; };
  std::sort(edges.begin(), edges.end(), by_start);
  std::vector<std::uint32_t> ring;
  for (std::uint32_t v = edges[0].from; ring.empty() || v != ring[0];) {
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), Edge{v, 0, 0}, by_start);
    if (last - first != 1 || ring.size() == edges.size()) return {};
    ring.push_back(v);
    v = first->to;
  }
  return ring.size() == edges.size() ? ring : std::vector<std::uint32_t>{};
}

/// Joins polygons with the same border along common edges.
class Merge {
 public:
  explicit Merge(std::span<Polygon> polygons) : polygons_(polygons), group_(polygons.size()) {
    for (std::uint32_t p = 0; p < polygons.size(); ++p) {
      const auto& loop = polygons[p].loop;
      for (std::size_t k = 0; k < loop.size(); ++k)
        edges_.push_back({loop[k], loop[(k + 1) % loop.size()], p});
    }
    drop_shared_edges();
  }

  void append_to(std::vector<Polygon>& out) {
    std::vector<std::vector<Edge>> outline(polygons_.size());
    for (const Edge& e : edges_) outline[group_.root(e.polygon)].push_back(e);
    std::vector<std::uint8_t> merged(polygons_.size(), 0);
    for (std::uint32_t g = 0; g < polygons_.size(); ++g) {
      if (outline[g].empty()) continue;
      std::vector<std::uint32_t> ring = single_ring(outline[g]);
      if (ring.size() < 3) continue;
      merged[g] = 1;
      out.push_back({std::move(ring), polygons_[g].border});
    }
    for (std::uint32_t p = 0; p < polygons_.size(); ++p)
      if (!merged[group_.root(p)]) out.push_back(std::move(polygons_[p]));
  }

 private:
  /// Removes the edges that two polygons share in opposite directions, and unites the groups of the two.
  void drop_shared_edges() {
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) {
      return std::tuple(std::minmax(a.from, a.to), a.polygon) <
             std::tuple(std::minmax(b.from, b.to), b.polygon);
    });
    std::size_t kept = 0;
    for (std::size_t k = 0; k < edges_.size(); ++k) {
      if (k + 1 < edges_.size() && same_ends(edges_[k], edges_[k + 1]) &&
          edges_[k].from == edges_[k + 1].to) {
        group_.unite(edges_[k].polygon, edges_[k + 1].polygon);
        ++k;
      } else {
        edges_[kept++] = edges_[k];
      }
    }
    edges_.resize(kept);
  }

  std::span<Polygon> polygons_;
  DisjointSets group_;
  std::vector<Edge> edges_;
};

std::vector<Polygon> merge_walls(std::vector<Polygon> polygons) {
  const auto same_border = [](const Polygon& a, const Polygon& b) { return a.border == b.border; };
  std::stable_sort(polygons.begin(), polygons.end(), [](const Polygon& a, const Polygon& b) {
    return std::pair(a.border.kind, a.border.index) < std::pair(b.border.kind, b.border.index);
  });
  std::vector<Polygon> out;
  for (auto begin = polygons.begin(); begin != polygons.end();) {
    auto end = begin + 1;
    while (end != polygons.end() && same_border(*begin, *end)) ++end;
    if (end - begin == 1 || begin->border.kind == Border::Kind::interior) {
      out.insert(out.end(), std::make_move_iterator(begin), std::make_move_iterator(end));
    } else {
      Merge(std::span(begin, end)).append_to(out);
    }
    begin = end;
  }
  return out;
}

/// The vertices that only split an edge between two walls: they belong to exactly two faces, of different
/// walls, with the same neighbouring vertices in both. Both planes contain the edge, so it is straight there.
class SplitVertices {
 public:
  SplitVertices(const CellWeld& weld, const std::vector<Polygon>& polygons)
      : uses_(weld.vertex_count()), splits_(weld.vertex_count(), 0) {
    for (const Polygon& polygon : polygons) {
      const auto& loop = polygon.loop;
      for (std::size_t k = 0; k < loop.size(); ++k)
        add_use(loop[k], loop[(k + loop.size() - 1) % loop.size()], loop[(k + 1) % loop.size()],
                polygon.border);
    }
    for (std::uint32_t v = 0; v < uses_.size(); ++v) {
      const Use& u = uses_[v];
      splits_[v] = weld.on_interior(v) && u.count == 2 && u.ends[0] == u.ends[1] &&
                   u.border[0].kind == Border::Kind::wall && u.border[1].kind == Border::Kind::wall &&
                   u.border[0].index != u.border[1].index;
    }
    keep_polygons(polygons);
  }
  bool operator[](std::uint32_t v) const { return splits_[v] != 0; }

 private:
  struct Use {
    std::array<std::pair<std::uint32_t, std::uint32_t>, 2> ends{};
    std::array<Border, 2> border{};
    std::uint32_t count = 0;
  };

  void add_use(std::uint32_t v, std::uint32_t before, std::uint32_t after, const Border& border) {
    Use& u = uses_[v];
    if (u.count < 2) {
      u.ends[u.count] = std::minmax(before, after);
      u.border[u.count] = border;
    }
    ++u.count;
  }

  /// Keeps all vertices of faces that would be left with fewer than three.
  void keep_polygons(const std::vector<Polygon>& polygons) {
    for (const Polygon& polygon : polygons) {
      const auto corners = std::count_if(polygon.loop.begin(), polygon.loop.end(),
                                         [&](std::uint32_t v) { return splits_[v] == 0; });
      if (corners > 2) continue;
      for (const std::uint32_t v : polygon.loop) splits_[v] = 0;
    }
  }

  std::vector<Use> uses_;
  std::vector<std::uint8_t> splits_;
};

}  // namespace

void join_polyhedron(const CellWeld& weld, JoinedFaces& faces) {
  const std::vector<Polygon> polygons = merge_walls(faces_left(weld));
  const SplitVertices split(weld, polygons);
  for (const Polygon& polygon : polygons) {
    for (const std::uint32_t v : polygon.loop)
      if (!split[v]) faces.loop.push_back(v);
    faces.end.push_back(faces.loop.size());
    faces.face_border.push_back(polygon.border);
  }
}

}  // namespace powercell
