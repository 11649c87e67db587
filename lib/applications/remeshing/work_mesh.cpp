#include "lib/applications/remeshing/work_mesh.hpp"

#include <algorithm>
#include <iterator>

#include "lib/applications/remeshing/triangle.hpp"

namespace powercell::remeshing {
namespace {

bool contains(const std::vector<std::uint32_t>& list, std::uint32_t v) {
  return std::find(list.begin(), list.end(), v) != list.end();
}

}  // namespace

Place project(const Surface& surface, const Place& from, Vec x) {
  Place best = from;
  double least = norm2(from.at - x);
  std::vector<std::uint32_t> seen = {from.triangle};
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const std::uint32_t t = seen[k];
    const Vec at = nearest_in_triangle(x, surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2));
    const double distance = norm2(at - x);
    if (distance > norm2(from.at - x)) continue;
    if (distance < least) {
      least = distance;
      best = {t, at};
    }
    for (const std::uint32_t next : surface.across[t])
      if (next != nothing && !contains(seen, next)) seen.push_back(next);
  }
  return best;
}

WorkMesh::WorkMesh(const Sampling& sampling, const DualMesh& dual) {
  const LocalDiagram& diagram = sampling.diagram();
  std::vector<std::uint32_t> number(diagram.size(), nothing);
  for (std::uint32_t i = 0; i < diagram.size(); ++i) {
    if (!diagram.seed(i).alive) continue;
    number[i] = static_cast<std::uint32_t>(vertex_.size());
    const Hold& hold = sampling.hold(i);
    vertex_.push_back({hold.place, sampling.sizing_at(hold.place), hold.kind, false});
  }
  alive_ = vertex_.size();
  chord_.resize(alive_);
  around_.resize(alive_);
  for (const auto& row : dual.triangle) {
    const auto t = static_cast<std::uint32_t>(triangle_.size());
    triangle_.push_back({number[row[0]], number[row[1]], number[row[2]]});
    for (const std::uint32_t v : triangle_.back()) around_[v].push_back(t);
  }
  for (std::uint32_t c = 0; c < sampling.curve_count(); ++c) {
    const auto& seeds = sampling.on_curve(c);
    for (std::size_t k = 0; k + 1 < seeds.size(); ++k) {
      link(number[seeds[k]], number[seeds[k + 1]]);
    }
  }
}

WorkMesh::WorkMesh(const Surface& surface, const Sizing& sizing, const std::vector<Curve>& curves) {
  std::vector<std::uint32_t> number(surface.vertex.size(), nothing);
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    for (const std::uint32_t v : surface.triangle[t]) {
      if (number[v] != nothing) continue;
      number[v] = static_cast<std::uint32_t>(vertex_.size());
      vertex_.push_back({{t, surface.vertex[v]}, sizing.h[v], Hold::Kind::free, false});
    }
  alive_ = vertex_.size();
  chord_.resize(alive_);
  around_.resize(alive_);
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    const auto& row = surface.triangle[t];
    triangle_.push_back({number[row[0]], number[row[1]], number[row[2]]});
    for (const std::uint32_t v : triangle_.back()) around_[v].push_back(t);
  }
  for (const Curve& curve : curves)
    for (std::size_t k = 0; k + 1 < curve.vertex.size(); ++k) {
      const std::uint32_t a = number[curve.vertex[k]], b = number[curve.vertex[k + 1]];
      const bool end = k == 0 && !curve.closed;
      vertex_[a].kind = end ? Hold::Kind::corner : Hold::Kind::curve;
      if (!curve.closed && k + 2 == curve.vertex.size()) vertex_[b].kind = Hold::Kind::corner;
      link(a, b);
    }
}

/// Makes the edge between two vertices a part of a kept curve.
void WorkMesh::link(std::uint32_t a, std::uint32_t b) {
  chord_[a].push_back(b);
  chord_[b].push_back(a);
  if (!edge(a, b)) vertex_[a].boundary = vertex_[b].boundary = true;
}

void WorkMesh::move(std::uint32_t v, const Place& place, double h) {
  vertex_[v].place = place;
  vertex_[v].h = h;
}

bool WorkMesh::kept(std::uint32_t a, std::uint32_t b) const {
  return contains(chord_[a], b);
}

std::vector<std::uint32_t> WorkMesh::neighbors(std::uint32_t v) const {
  std::vector<std::uint32_t> result;
  for (const std::uint32_t t : around_[v])
    for (const std::uint32_t u : triangle_[t])
      if (u != v) result.push_back(u);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

bool WorkMesh::adjacent(std::uint32_t a, std::uint32_t b) const {
  return std::any_of(around_[a].begin(), around_[a].end(), [&](std::uint32_t t) {
    return std::find(triangle_[t].begin(), triangle_[t].end(), b) != triangle_[t].end();
  });
}

std::optional<WorkMesh::Edge> WorkMesh::edge(std::uint32_t a, std::uint32_t b) const {
  Edge edge{a, b, nothing, nothing, nothing, nothing};
  for (const std::uint32_t t : around_[a])
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangle_[t][k], to = triangle_[t][(k + 1) % 3],
                          apex = triangle_[t][(k + 2) % 3];
      if (from == a && to == b) {
        edge.c = apex;
        edge.left = t;
      } else if (from == b && to == a) {
        edge.d = apex;
        edge.right = t;
      }
    }
  if (edge.left == nothing || edge.right == nothing) return std::nullopt;
  return edge;
}

void WorkMesh::detach(std::uint32_t v, std::uint32_t t) {
  auto& list = around_[v];
  *std::find(list.begin(), list.end(), t) = list.back();
  list.pop_back();
}

bool WorkMesh::can_flip(const Edge& e) const {
  return e.c != e.d && !kept(e.a, e.b) && degree(e.a) > 3 && degree(e.b) > 3 && !adjacent(e.c, e.d);
}

void WorkMesh::flip(const Edge& e) {
  triangle_[e.left] = {e.a, e.d, e.c};
  triangle_[e.right] = {e.d, e.b, e.c};
  detach(e.b, e.left);
  detach(e.a, e.right);
  around_[e.d].push_back(e.left);
  around_[e.c].push_back(e.right);
}

std::vector<std::uint32_t> WorkMesh::triangles_at(std::uint32_t a, std::uint32_t b) const {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : around_[a])
    if (std::find(triangle_[t].begin(), triangle_[t].end(), b) != triangle_[t].end()) found.push_back(t);
  return found;
}

bool WorkMesh::can_collapse(std::uint32_t a, std::uint32_t b, std::size_t least_degree) const {
  const Vertex& vertex = vertex_[a];
  if (vertex.kind == Hold::Kind::corner || (vertex.kind == Hold::Kind::curve && !kept(a, b))) return false;
  const std::vector<std::uint32_t> gone = triangles_at(a, b);
  if (gone.empty()) return false;
  // The ends may share no neighbours but those opposite to the edge, whose degrees must stay large enough.
  const std::vector<std::uint32_t> of_a = neighbors(a), of_b = neighbors(b);
  std::vector<std::uint32_t> common;
  std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
  if (common.size() != gone.size() || of_a.size() + of_b.size() < 2 + gone.size() + least_degree)
    return false;
  return std::all_of(common.begin(), common.end(),
                     [&](std::uint32_t c) { return degree(c) > 3 && !kept(a, c); });
}

void WorkMesh::collapse(std::uint32_t a, std::uint32_t b) {
  for (const std::uint32_t t : triangles_at(a, b)) {
    for (const std::uint32_t v : Corners(triangle_[t])) detach(v, t);
    triangle_[t] = {0, 0, 0};
  }
  for (const std::uint32_t t : around_[a]) {
    std::replace(triangle_[t].begin(), triangle_[t].end(), a, b);
    around_[b].push_back(t);
  }
  around_[a].clear();
  for (const std::uint32_t c : chord_[a]) {  // a vertex of a curve: its other neighbour there takes b
    if (c == b) {
      std::erase(chord_[b], a);
    } else {
      std::replace(chord_[c].begin(), chord_[c].end(), a, b);
      chord_[b].push_back(c);
    }
  }
  chord_[a].clear();
  --alive_;
}

std::uint32_t WorkMesh::split(const Edge& e, const Place& place, double h) {
  const auto v = static_cast<std::uint32_t>(vertex_.size());
  vertex_.push_back({place, h, Hold::Kind::free, false});
  chord_.emplace_back();
  around_.emplace_back();
  ++alive_;
  const auto new_left = static_cast<std::uint32_t>(triangle_.size()), new_right = new_left + 1;
  triangle_[e.left] = {e.a, v, e.c};
  triangle_[e.right] = {v, e.a, e.d};
  triangle_.push_back({v, e.b, e.c});
  triangle_.push_back({e.b, v, e.d});
  detach(e.b, e.left);
  detach(e.b, e.right);
  around_[e.b].insert(around_[e.b].end(), {new_left, new_right});
  around_[e.c].push_back(new_left);
  around_[e.d].push_back(new_right);
  around_[v] = {e.left, e.right, new_left, new_right};
  return v;
}

}  // namespace powercell::remeshing
