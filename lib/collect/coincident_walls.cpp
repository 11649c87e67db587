#include "lib/collect/coincident_walls.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "lib/base/disjoint_sets.hpp"
#include "lib/solid/tile.hpp"

namespace powercell {
namespace {

using Point = Vector3<double>;
using Loop = std::vector<std::uint32_t>;
using solid::DirectedEdge;

/// Points are the same within this part of the largest coordinate, as seen from different seeds.
constexpr double rounding = 0x1p-44;

struct Face {
  Loop loop;
  Border border;
};

/// One cell that can be changed.
class Surface {
 public:
  Surface(const JoinedCells& cells, std::size_t i) {
    for (std::uint64_t v = cells.vertex_offset[i]; v < cells.vertex_offset[i + 1]; ++v)
      at.push_back({cells.vertices[3 * v], cells.vertices[3 * v + 1], cells.vertices[3 * v + 2]});
    for (std::uint64_t f = cells.face_offset[i]; f < cells.face_offset[i + 1]; ++f)
      faces.push_back({{cells.loop.begin() + static_cast<std::ptrdiff_t>(cells.loop_offset[f]),
                        cells.loop.begin() + static_cast<std::ptrdiff_t>(cells.loop_offset[f + 1])},
                       cells.face_border[f]});
  }

  std::vector<Point> at;
  std::vector<Face> faces;

  /// Takes the faces with a border away.
  std::vector<Loop> take(const Border& border) {
    std::vector<Loop> taken;
    for (Face& face : faces)
      if (face.border == border) taken.push_back(std::move(face.loop));
    std::erase_if(faces, [&](const Face& face) { return face.border == border; });
    return taken;
  }
  Loop add_vertices(const std::vector<Point>& points) {
    Loop loop;
    for (const Point& x : points) {
      loop.push_back(static_cast<std::uint32_t>(at.size()));
      at.push_back(x);
    }
    return loop;
  }
  /// Replaces the part of a wall between `loops` (the wall), minus `minus`, which lie in it the same way
  /// round.
  void replace_wall(const Border& border, const std::vector<Loop>& loops, const std::vector<Loop>& minus,
                    const Point& normal);
  void append_to(JoinedCells& out) const;

 private:
  void weld(std::vector<DirectedEdge>& edges);
  /// Edges end at the vertices in their middle; what is between the edge and its parts is a flat face.
  void split(std::vector<DirectedEdge>& edges, const Border& border);
  double tolerance() const {
    double most = 0;
    for (const Point& x : at) most = std::max({most, std::fabs(x[0]), std::fabs(x[1]), std::fabs(x[2])});
    return rounding * most;
  }
};

void append_edges(const Loop& loop, bool reversed, std::vector<DirectedEdge>& edges) {
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
    edges.push_back(reversed ? DirectedEdge{b, a} : DirectedEdge{a, b});
  }
}

Loop vertices_of(const std::vector<DirectedEdge>& edges) {
  Loop vertices;
  for (const DirectedEdge& edge : edges) vertices.push_back(edge.from);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

void Surface::weld(std::vector<DirectedEdge>& edges) {
  Loop order = vertices_of(edges);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return at[a] < at[b]; });
  const double within = tolerance();
  DisjointSets same(at.size());
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size() && at[order[b]][0] <= at[order[a]][0] + within; ++b)
      if (norm(at[order[a]] - at[order[b]]) <= within) same.unite(order[a], order[b]);
  for (DirectedEdge& edge : edges) edge = {same.root(edge.from), same.root(edge.to)};
  for (Face& face : faces) {
    for (std::uint32_t& v : face.loop) v = same.root(v);
    face.loop.erase(std::unique(face.loop.begin(), face.loop.end()), face.loop.end());
    while (face.loop.size() > 1 && face.loop.front() == face.loop.back()) face.loop.pop_back();
  }
  std::erase_if(faces, [](const Face& face) { return face.loop.size() < 3; });
}

void Surface::split(std::vector<DirectedEdge>& edges, const Border& border) {
  const Loop vertices = vertices_of(edges);
  const double within = tolerance();
  std::vector<DirectedEdge> parts;
  for (const DirectedEdge& edge : edges) {
    const Point a = at[edge.from], along = at[edge.to] - a;
    const double length = norm(along);
    std::vector<std::pair<double, std::uint32_t>> between;
    for (const std::uint32_t v : vertices) {
      if (v == edge.from || v == edge.to || length <= within) continue;
      const Point to = at[v] - a;
      const double share = dot(to, along) / (length * length);
      if (share > 0 && share < 1 && norm(to - share * along) <= within) between.emplace_back(share, v);
    }
    std::sort(between.begin(), between.end());
    std::uint32_t last = edge.from;
    Face flat{{edge.from, edge.to}, border};
    Loop middle;
    for (const auto& [share, v] : between) {
      middle.push_back(v);
      parts.push_back({last, v});
      last = v;
    }
    parts.push_back({last, edge.to});
    flat.loop.insert(flat.loop.end(), middle.rbegin(), middle.rend());
    if (!between.empty()) faces.push_back(std::move(flat));
  }
  edges = std::move(parts);
}

void Surface::replace_wall(const Border& border, const std::vector<Loop>& loops,
                           const std::vector<Loop>& minus, const Point& normal) {
  std::vector<DirectedEdge> edges;
  for (const Loop& loop : loops) append_edges(loop, false, edges);
  for (const Loop& loop : minus) append_edges(loop, true, edges);
  weld(edges);
  split(edges, border);
  const solid::Polygons parts = solid::tile(std::move(edges), at, normal);
  for (std::size_t p = 0; p < parts.end.size(); ++p)
    faces.push_back({{parts.loop(p).begin(), parts.loop(p).end()}, border});
}

void Surface::append_to(JoinedCells& out) const {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  Loop number(at.size(), none);
  std::uint32_t used = 0;
  for (const Face& face : faces) {
    for (const std::uint32_t v : face.loop) {
      if (number[v] == none) {
        number[v] = used++;
        out.vertices.insert(out.vertices.end(), at[v].begin(), at[v].end());
      }
      out.loop.push_back(number[v]);
    }
    out.loop_offset.push_back(out.loop.size());
    out.face_border.push_back(face.border);
  }
  out.vertex_offset.push_back(out.vertices.size() / 3);
  out.face_offset.push_back(out.face_border.size());
}

class Moving {
 public:
  Moving(const JoinedCells& cells, std::span<const double> positions)
      : cells_(cells), positions_(positions) {}

  /// Moves the parts of the wall between two cells.
  void move(std::span<const CoincidentWall> walls) {
    const std::uint32_t i = walls[0].front, j = walls[0].behind;
    Surface &front = surface(i), &behind = surface(j);
    const Point normal = difference<double>(&positions_[3 * std::size_t{j}], &positions_[3 * std::size_t{i}]);
    std::vector<Loop> in_front, at_behind;
    for (const CoincidentWall& wall : walls)
      for (Loop& loop : front.take({Border::Kind::boundary, wall.triangle})) {
        std::vector<Point> points;
        for (const std::uint32_t v : loop) points.push_back(front.at[v]);
        at_behind.push_back(behind.add_vertices(points));
        behind.faces.push_back({at_behind.back(), {Border::Kind::boundary, wall.triangle}});
        in_front.emplace_back(loop.rbegin(), loop.rend());
      }
    if (in_front.empty()) return;
    const Border to_behind{Border::Kind::wall, j}, to_front{Border::Kind::wall, i};
    front.replace_wall(to_behind, front.take(to_behind), in_front, normal);
    behind.replace_wall(to_front, behind.take(to_front), at_behind, -1.0 * normal);
  }

  JoinedCells finish() const {
    JoinedCells out;
    out.dimension = out.cell_dimension = 3;
    out.vertex_offset = out.face_offset = out.loop_offset = {0};
    for (std::size_t i = 0; i + 1 < cells_.vertex_offset.size(); ++i) {
      const auto changed = surfaces_.find(static_cast<std::uint32_t>(i));
      (changed == surfaces_.end() ? Surface(cells_, i) : changed->second).append_to(out);
    }
    return out;
  }

 private:
  Surface& surface(std::uint32_t i) { return surfaces_.try_emplace(i, cells_, i).first->second; }

  const JoinedCells& cells_;
  std::span<const double> positions_;
  std::map<std::uint32_t, Surface> surfaces_;
};

}  // namespace

JoinedCells without_coincident_walls(const JoinedCells& cells, std::vector<CoincidentWall> walls,
                                     std::span<const double> positions) {
  const auto key = [](const CoincidentWall& w) { return std::tuple(w.front, w.behind, w.triangle); };
  std::sort(walls.begin(), walls.end(),
            [&](const CoincidentWall& a, const CoincidentWall& b) { return key(a) < key(b); });
  Moving moving(cells, positions);
  for (std::size_t first = 0, last; first < walls.size(); first = last) {
    for (last = first; last < walls.size() && walls[last].front == walls[first].front &&
                       walls[last].behind == walls[first].behind;)
      ++last;
    moving.move(std::span(walls).subspan(first, last - first));
  }
  return moving.finish();
}

}  // namespace powercell
