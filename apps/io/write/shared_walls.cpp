#include "apps/io/write/shared_walls.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "apps/io/groups.hpp"

namespace powercell::io {
namespace {

using WallLoop = std::vector<std::uint32_t>;

struct WallEdge {
  std::uint32_t from, to, wall;
};

/// Whether the wall is left to the cell of a lower seed.
bool is_of_other(const SharedWall& wall) {
  return wall.border.kind == Border::Kind::wall && wall.shift == std::array<std::int32_t, 3>{} &&
         wall.border.index < wall.cell;
}

/// Without points that repeat the one before; empty if less than a polygon is left.
void drop_repeated(WallLoop& loop) {
  loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  if (loop.size() < 3) loop.clear();
}

/// The ring that the edges form; empty if they form several, or one that touches itself in a point.
WallLoop single_ring(std::vector<WallEdge>& edges) {
  const auto by_start = [](const WallEdge& a, const WallEdge& b) { return a.from < b.from; };
  std::sort(edges.begin(), edges.end(), by_start);
  WallLoop ring;
  for (std::uint32_t v = edges[0].from; ring.empty() || v != ring[0];) {
    const auto [first, last] = std::equal_range(edges.begin(), edges.end(), WallEdge{v, 0, 0}, by_start);
    if (last - first != 1 || ring.size() == edges.size()) return {};
    ring.push_back(v);
    v = first->to;
  }
  return ring.size() == edges.size() ? ring : WallLoop{};
}

/// Joins the parts of one wall along their common edges, where one ring is left around them.
void append_joined(std::vector<SharedWall> parts, std::vector<SharedWall>& out) {
  Groups groups(parts.size());
  std::vector<WallEdge> edges, outline;
  for (std::uint32_t p = 0; p < parts.size(); ++p)
    for (std::size_t k = 0; k < parts[p].loop.size(); ++k)
      edges.push_back({parts[p].loop[k], parts[p].loop[(k + 1) % parts[p].loop.size()], p});
  std::sort(edges.begin(), edges.end(), [](const WallEdge& a, const WallEdge& b) {
    return std::tuple(std::minmax(a.from, a.to), a.wall) < std::tuple(std::minmax(b.from, b.to), b.wall);
  });
  for (std::size_t k = 0; k < edges.size(); ++k) {
    if (k + 1 < edges.size() && edges[k].from == edges[k + 1].to && edges[k].to == edges[k + 1].from) {
      groups.unite(edges[k].wall, edges[k + 1].wall);
      ++k;
    } else {
      outline.push_back(edges[k]);
    }
  }
  std::vector<std::vector<WallEdge>> of_group(parts.size());
  for (const WallEdge& edge : outline) of_group[groups.of(edge.wall)].push_back(edge);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    const std::uint32_t group = groups.of(p);
    if (p == group && !of_group[p].empty()) {
      WallLoop ring = single_ring(of_group[p]);
      if (ring.size() > 2) {
        parts[p].loop = std::move(ring);
        of_group[p].clear();
        out.push_back(parts[p]);
        continue;
      }
    }
    if (!of_group[group].empty()) out.push_back(std::move(parts[p]));
  }
}

/// The faces of a cell, those of one wall one after the other.
void append_cell(std::vector<SharedWall> faces, std::vector<SharedWall>& out) {
  const auto key = [](const SharedWall& w) { return std::tuple(w.border.kind, w.border.index, w.shift); };
  std::stable_sort(faces.begin(), faces.end(),
                   [&](const SharedWall& a, const SharedWall& b) { return key(a) < key(b); });
  for (std::size_t first = 0, last; first < faces.size(); first = last) {
    for (last = first + 1; last < faces.size() && key(faces[last]) == key(faces[first]);) ++last;
    const auto begin = std::make_move_iterator(faces.begin());
    std::vector<SharedWall> parts(begin + static_cast<std::ptrdiff_t>(first),
                                  begin + static_cast<std::ptrdiff_t>(last));
    if (parts.size() == 1)
      out.push_back(std::move(parts[0]));
    else
      append_joined(std::move(parts), out);
  }
}

std::vector<SharedWall> of_solid(const JoinedCells& joined, const SharedPoints& points) {
  std::vector<SharedWall> walls;
  for (std::uint32_t i = 0; i + 1 < joined.face_offset.size(); ++i)
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f) {
      SharedWall wall{{}, i, joined.face_border[f], {}};
      if (is_of_other(wall)) continue;
      for (std::uint64_t e = joined.loop_offset[f]; e < joined.loop_offset[f + 1]; ++e)
        wall.loop.push_back(points.number[joined.vertex_offset[i] + joined.loop[e]]);
      drop_repeated(wall.loop);
      if (!wall.loop.empty()) walls.push_back(std::move(wall));
    }
  return walls;
}

std::vector<SharedWall> of_regions(const Cells& cells, const SharedPoints& points) {
  std::vector<SharedWall> walls;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i) {
    std::vector<SharedWall> faces;
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
        SharedWall wall{{}, i, cells.border[f], {}};
        if (!cells.shift.empty()) wall.shift = cells.shift[f];
        if (wall.border.kind == Border::Kind::interior || is_of_other(wall)) continue;
        for (std::uint64_t e = cells.loop_offset[f]; e < cells.loop_offset[f + 1]; ++e)
          wall.loop.push_back(points.number[cells.vertex_offset[p] + cells.loop[e]]);
        drop_repeated(wall.loop);
        if (!wall.loop.empty()) faces.push_back(std::move(wall));
      }
    append_cell(std::move(faces), walls);
  }
  return walls;
}

/// The points that only split an edge: all faces that have one have it between the same two points, and the
/// faces are of at least two walls, whose planes both contain that edge, so that it is straight.
class SplitPoints {
 public:
  SplitPoints(const std::vector<SharedWall>& walls, const SharedPoints& points)
      : of_(points.size()), between_(points.between) {
    for (const SharedWall& wall : walls)
      for (std::size_t k = 0; k < wall.loop.size(); ++k) add(wall, k);
    for (const SharedWall& wall : walls) keep_polygon(wall.loop);
  }
  bool is_split(std::uint32_t p) const { return between_[p] && of_[p].straight && of_[p].two_walls; }

 private:
  struct Use {
    std::pair<std::uint32_t, std::uint32_t> ends{}, wall{};
    bool any = false, straight = true, two_walls = false;
  };

  void add(const SharedWall& wall, std::size_t k) {
    const std::size_t n = wall.loop.size();
    Use& use = of_[wall.loop[k]];
    const auto ends = std::minmax(wall.loop[(k + n - 1) % n], wall.loop[(k + 1) % n]);
    const std::pair<std::uint32_t, std::uint32_t> of{wall.cell, wall.border.index};
    if (!use.any) {
      use.any = true;
      use.ends = ends;
      use.wall = of;
    }
    if (wall.border.kind != Border::Kind::wall || use.ends != std::pair<std::uint32_t, std::uint32_t>(ends))
      use.straight = false;
    if (use.wall != of) use.two_walls = true;
  }
  /// Keeps all points of a face that would be left with fewer than three.
  void keep_polygon(const WallLoop& loop) {
    const auto left = std::count_if(loop.begin(), loop.end(), [&](std::uint32_t p) { return !is_split(p); });
    if (left > 2) return;
    for (const std::uint32_t p : loop) of_[p].straight = false;
  }

  std::vector<Use> of_;
  const std::vector<std::uint8_t>& between_;
};

}  // namespace

std::vector<SharedWall> shared_walls(const DiagramOutput& output, const SharedPoints& points) {
  if (output.domain.is_solid()) return of_solid(output.joined, points);
  std::vector<SharedWall> walls = of_regions(output.cells, points);
  const SplitPoints split(walls, points);
  for (SharedWall& wall : walls) std::erase_if(wall.loop, [&](std::uint32_t p) { return split.is_split(p); });
  return walls;
}

}  // namespace powercell::io
