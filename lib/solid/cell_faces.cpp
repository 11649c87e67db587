#include "lib/solid/cell_faces.hpp"

#include <algorithm>
#include <cmath>

#include "lib/base/disjoint_sets.hpp"
#include "lib/solid/tile.hpp"

namespace powercell::solid {
namespace {

/// An edge of the part within a wall of the cell, with the wall on its left seen from outside.
struct WallEdge {
  std::uint32_t wall;
  DirectedEdge edge;
};

class Maker {
 public:
  explicit Maker(const CellFacesInput& input) : input_(input), cell_(input.cell) {}

  CellFaces make() {
    number_vertices();
    add_pieces();
    add_cell_edges();
    weld();
    for (std::size_t p = 0; p < piece_end_.size(); ++p)
      append_face(loop_of_piece(p), ~static_cast<std::int32_t>(input_.pieces[p].triangle));
    append_walls();
    add_corners();
    return std::move(out_);
  }

 private:
  std::uint32_t add_vertex(const Point& at) {
    at_.push_back(at);
    return static_cast<std::uint32_t>(at_.size() - 1);
  }

  void number_vertices();
  void add_pieces();
  void add_cell_edges();
  void add_cell_edge(std::uint32_t edge, std::span<const std::uint32_t> crossings);
  void weld();
  std::vector<std::uint32_t> loop_of_piece(std::size_t p);
  /// Drops repeated vertices, and loops of two: their edges cancel.
  void append_face(std::vector<std::uint32_t> loop, std::int32_t border);
  void append_walls();
  void append_wall(std::int32_t border, const std::vector<DirectedEdge>& edges);
  void add_corners();

  const CellFacesInput& input_;
  const CellInSolid& cell_;
  std::vector<Point> at_;
  std::vector<std::uint32_t> piece_, of_cell_, of_crossing_;  // numbers of vertices
  std::vector<std::size_t> piece_end_;
  std::vector<WallEdge> wall_edges_;
  DisjointSets welded_;
  std::vector<std::uint32_t> number_;  // in out_
  CellFaces out_;
};

void Maker::number_vertices() {
  const std::vector<CellInSolid::RingVertex>& ring = cell_.ring();
  std::vector<std::uint32_t> of_edge_point(cell_.edge_points(), none);
  Lookup of_corner;
  std::size_t first = 0;
  for (const BoundaryPiece& piece : input_.pieces) {
    const std::size_t count = piece.border.size();
    for (std::size_t k = 0; k < count; ++k) {
      const bool in_wall[2] = {piece.border[k == 0 ? count - 1 : k - 1] >= 0, piece.border[k] >= 0};
      const CellInSolid::RingVertex& vertex = ring[first + k];
      std::uint32_t v;
      if (in_wall[0] && in_wall[1]) {
        v = add_vertex(vertex.at);
        of_crossing_.push_back(v);
      } else if (in_wall[0] || in_wall[1]) {
        v = of_edge_point[vertex.edge_point];
        if (v == none) v = of_edge_point[vertex.edge_point] = add_vertex(vertex.at);
      } else {
        const std::uint32_t corner = piece.corners[static_cast<std::size_t>(~piece.border[k])];
        v = of_corner.find(corner);
        if (v == none) of_corner.add(corner, v = add_vertex(vertex.at));
      }
      piece_.push_back(v);
    }
    first += count;
    piece_end_.push_back(first);
  }
  for (std::uint32_t v = 0; v < cell_.cell().vertices(); ++v)
    of_cell_.push_back(cell_.side(v) == Side::inside ? add_vertex(cell_.vertex(v)) : none);
}

void Maker::add_pieces() {
  std::size_t first = 0;
  for (const BoundaryPiece& piece : input_.pieces) {
    const std::size_t count = piece.border.size();
    for (std::size_t k = 0; k < count; ++k)
      if (piece.border[k] >= 0)
        wall_edges_.push_back({cell_.ring()[first + k].face,
                               {piece_[first + (k + 1 == count ? 0 : k + 1)], piece_[first + k]}});
    first += count;
  }
}

/// Each way into the solid is followed by a way out. Ways in are ordered among themselves, and so are ways
/// out, so that the two ends of a part that is within rounding cannot be confused with others.
void Maker::add_cell_edge(std::uint32_t edge, std::span<const std::uint32_t> crossings) {
  const std::uint32_t v = edge / 3, u = cell_.next(edge);
  const Point from = cell_.vertex(v), along = cell_.vertex(u) - from;
  std::vector<std::pair<double, std::uint32_t>> in, out;
  for (const std::uint32_t c : crossings) {
    const CellInSolid::Crossing& crossing = cell_.crossings()[c];
    (crossing.leaves > 0 ? out : in).emplace_back(dot(along, crossing.at - from), of_crossing_[c]);
  }
  if (of_cell_[v] != none) in.emplace_back(-HUGE_VAL, of_cell_[v]);
  if (of_cell_[u] != none) out.emplace_back(HUGE_VAL, of_cell_[u]);
  std::sort(in.begin(), in.end());
  std::sort(out.begin(), out.end());
  for (std::size_t k = 0; k < in.size(); ++k) {
    wall_edges_.push_back({cell_.left(edge), {in[k].second, out[k].second}});
    wall_edges_.push_back({cell_.right(edge), {out[k].second, in[k].second}});
  }
}

void Maker::add_cell_edges() {
  std::vector<std::uint32_t> order(cell_.crossings().size());
  for (std::uint32_t c = 0; c < order.size(); ++c) order[c] = c;
  const auto edge_of = [&](std::uint32_t c) { return cell_.crossings()[c].edge; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return edge_of(a) < edge_of(b); });
  std::size_t first = 0;
  for (std::uint32_t edge = 0; edge < 3 * cell_.cell().vertices(); ++edge) {
    if (!cell_.is_lower(edge)) continue;
    std::size_t last = first;
    while (last < order.size() && edge_of(order[last]) == edge) ++last;
    add_cell_edge(edge, std::span(order).subspan(first, last - first));
    first = last;
  }
}

void Maker::weld() {
  welded_.reset(at_.size());
  const auto unite_short = [&](std::uint32_t a, std::uint32_t b) {
    if (norm(at_[a] - at_[b]) <= input_.rounding) welded_.unite(a, b);
  };
  for (std::size_t p = 0, k = 0; p < piece_end_.size(); ++p)
    for (const std::size_t first = k; k < piece_end_[p]; ++k)
      unite_short(piece_[k], piece_[k + 1 == piece_end_[p] ? first : k + 1]);
  for (const auto& [wall, edge] : wall_edges_) unite_short(edge.from, edge.to);
  for (auto& [wall, edge] : wall_edges_) edge = {welded_.root(edge.from), welded_.root(edge.to)};
  number_.assign(at_.size(), none);
}

std::vector<std::uint32_t> Maker::loop_of_piece(std::size_t p) {
  std::vector<std::uint32_t> loop;
  for (std::size_t k = p == 0 ? 0 : piece_end_[p - 1]; k < piece_end_[p]; ++k)
    loop.push_back(welded_.root(piece_[k]));
  return loop;
}

void Maker::append_face(std::vector<std::uint32_t> loop, std::int32_t border) {
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  if (loop.size() < 3) return;
  for (const std::uint32_t v : loop) {
    if (number_[v] == none) {
      number_[v] = static_cast<std::uint32_t>(out_.vertices.size() / 3);
      out_.vertices.insert(out_.vertices.end(), at_[v].begin(), at_[v].end());
    }
    out_.loop.push_back(number_[v]);
  }
  out_.end.push_back(out_.loop.size());
  out_.border.push_back(border);
}

void Maker::append_walls() {
  std::stable_sort(wall_edges_.begin(), wall_edges_.end(),
                   [](const WallEdge& a, const WallEdge& b) { return a.wall < b.wall; });
  std::vector<DirectedEdge> edges;
  for (std::size_t first = 0, last; first < wall_edges_.size(); first = last) {
    edges.clear();
    for (last = first; last < wall_edges_.size() && wall_edges_[last].wall == wall_edges_[first].wall; ++last)
      edges.push_back(wall_edges_[last].edge);
    append_wall(cell_.cell().border[wall_edges_[first].wall], edges);
  }
}

void Maker::append_wall(std::int32_t border, const std::vector<DirectedEdge>& edges) {
  const Point normal = difference<double>(&cell_.positions()[3 * static_cast<std::size_t>(border)],
                                          &cell_.positions()[3 * std::size_t{cell_.rank()}]);
  const Polygons parts = tile(edges, at_, normal);
  for (std::size_t p = 0; p < parts.end.size(); ++p) {
    const std::span<const std::uint32_t> part = parts.loop(p);
    append_face({part.begin(), part.end()}, border);
  }
}

void Maker::add_corners() {
  const WholeCell& cell = cell_.cell();
  for (std::uint32_t v = 0; v < cell.vertices(); ++v) {
    if (of_cell_[v] == none) continue;
    std::array<std::uint32_t, 3> ranks;
    for (std::size_t k = 0; k < 3; ++k)
      ranks[k] = static_cast<std::uint32_t>(cell.border[cell.link[6 * std::size_t{v} + 3 + k]]);
    out_.corners.push_back(ranks);
  }
}

}  // namespace

CellFaces make_cell_faces(const CellFacesInput& input) {
  return Maker(input).make();
}

}  // namespace powercell::solid
