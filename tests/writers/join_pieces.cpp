#include "tests/writers/join_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace powercell::test {
namespace {

struct Edge {
  std::uint32_t from, to;
  Border border;
};

// A cell that is being joined.
struct Joining {
  const Cells& cells;
  JoinedCells& joined;
  std::map<std::array<std::int64_t, 3>, std::uint32_t> places;

  std::uint32_t vertex(std::uint64_t v) {
    const auto d = static_cast<std::size_t>(cells.dimension);
    std::array<std::int64_t, 3> place{};
    for (std::size_t k = 0; k < d; ++k) place[k] = std::llround(cells.vertices[v * d + k] * 1e9);
    const auto [at, added] = places.try_emplace(place, static_cast<std::uint32_t>(places.size()));
    if (added) {
      const auto from = cells.vertices.begin() + static_cast<std::ptrdiff_t>(v * d);
      joined.vertices.insert(joined.vertices.end(), from, from + cells.dimension);
    }
    return at->second;
  }
  std::vector<Edge> edges(std::uint64_t piece) {
    std::vector<Edge> result;
    const std::uint64_t first = cells.vertex_offset[piece], end = cells.vertex_offset[piece + 1];
    for (std::uint64_t v = first; v < end; ++v) {
      const Edge edge{vertex(v), vertex(v + 1 < end ? v + 1 : first),
                      cells.border[cells.face_offset[piece] + (v - first)]};
      if (edge.from != edge.to) result.push_back(edge);
    }
    return result;
  }
  void end_face() { joined.loop_offset.push_back(joined.loop.size()); }
  void add_polygon(const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) {
      joined.loop.push_back(edge.from);
      joined.edge_border.push_back(edge.border);
    }
    end_face();
  }
  void add_rings(std::vector<Edge> open) {
    while (!open.empty()) {
      std::vector<Edge> ring = {open.back()};
      open.pop_back();
      while (ring.back().to != ring.front().from) {
        const auto next =
            std::find_if(open.begin(), open.end(), [&](const Edge& e) { return e.from == ring.back().to; });
        if (next == open.end()) break;
        ring.push_back(*next);
        open.erase(next);
      }
      add_polygon(ring);
    }
  }
  void add_faces(std::uint64_t piece) {
    for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f) {
      if (cells.border[f].kind == Border::Kind::interior) continue;
      for (std::uint64_t e = cells.loop_offset[f]; e < cells.loop_offset[f + 1]; ++e) {
        joined.loop.push_back(vertex(cells.vertex_offset[piece] + cells.loop[e]));
      }
      joined.face_border.push_back(cells.border[f]);
      end_face();
    }
  }
};

}  // namespace

JoinedCells join_pieces(const Cells& cells) {
  JoinedCells joined;
  joined.dimension = cells.dimension;
  joined.cell_dimension = cells.cell_dimension;
  joined.vertex_offset = joined.face_offset = joined.loop_offset = {0};
  for (std::size_t i = 0; i < cells.cell_count(); ++i) {
    Joining joining{cells, joined, {}};
    std::vector<Edge> open;
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      if (cells.cell_dimension == 3) {
        joining.add_faces(p);
        continue;
      }
      const std::vector<Edge> edges = joining.edges(p);
      if (cells.dimension == 3) joining.add_polygon(edges);
      for (const Edge& edge : edges) {
        if (cells.dimension == 2 && edge.border.kind != Border::Kind::interior) open.push_back(edge);
      }
    }
    joining.add_rings(std::move(open));
    joined.vertex_offset.push_back(joined.vertices.size() / static_cast<std::size_t>(cells.dimension));
    joined.face_offset.push_back(joined.loop_offset.size() - 1);
  }
  return joined;
}

}  // namespace powercell::test
