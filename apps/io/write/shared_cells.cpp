#include "apps/io/write/shared_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <powercell/error.hpp>
#include <tuple>
#include <utility>

#include "apps/io/write/shared_points.hpp"
#include "apps/io/write/shared_walls.hpp"

namespace powercell::io {
namespace {

using PointPair = std::pair<std::uint32_t, std::uint32_t>;

constexpr std::array<std::int32_t, 3> no_shift{};

void start_cells(SharedCells& shared, const DiagramOutput& output) {
  shared.cell_dimension = output.domain.cell_dimension();
  shared.face_offset = shared.loop_offset = {0};
}

/// The same face may be twice in a list: of the cell itself, and from the other side.
struct FaceOfCell {
  std::uint64_t wall;
  bool behind;
};

void add_face(SharedCells& shared, const SharedWall& wall, bool behind, bool periodic) {
  if (behind) {  // begins with the same point
    shared.loop.push_back(wall.loop[0]);
    shared.loop.insert(shared.loop.end(), wall.loop.rbegin(), wall.loop.rend() - 1);
  } else {
    shared.loop.insert(shared.loop.end(), wall.loop.begin(), wall.loop.end());
  }
  shared.loop_offset.push_back(shared.loop.size());
  shared.face_border.push_back(behind ? Border{Border::Kind::wall, wall.cell} : wall.border);
  if (periodic) shared.shift.push_back(wall.shift);  // none of a wall that is seen from behind
}

void add_volumes(SharedCells& shared, const std::vector<SharedWall>& walls, std::size_t count,
                 bool periodic) {
  std::vector<std::vector<FaceOfCell>> faces(count);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    faces[walls[w].cell].push_back({w, false});
    if (walls[w].border.kind == Border::Kind::wall && walls[w].shift == no_shift)
      faces[walls[w].border.index].push_back({w, true});
  }
  constexpr std::uint64_t none = ~std::uint64_t{0};
  std::vector<std::uint64_t> first(walls.size(), none);
  for (const std::vector<FaceOfCell>& of_cell : faces) {
    for (const auto& [w, behind] : of_cell) {
      const std::uint64_t f = shared.face_count();
      add_face(shared, walls[w], behind, periodic);
      shared.twin.push_back(f);
      if (first[w] == none) {
        first[w] = f;
      } else {
        shared.twin[f] = first[w];
        shared.twin[first[w]] = f;
      }
    }
    shared.face_offset.push_back(shared.face_count());
  }
}

/// Of each cell every edge must occur as often in one direction as in the other.
std::string fault_of_volumes(const SharedCells& shared) {
  std::vector<PointPair> forth, back;
  for (std::size_t i = 0; i < shared.cell_count(); ++i) {
    forth.clear();
    back.clear();
    for (std::uint64_t f = shared.face_offset[i]; f < shared.face_offset[i + 1]; ++f) {
      const auto loop = shared.face(f);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        forth.emplace_back(loop[k], loop[(k + 1) % loop.size()]);
        back.emplace_back(loop[(k + 1) % loop.size()], loop[k]);
      }
    }
    std::sort(forth.begin(), forth.end());
    std::sort(back.begin(), back.end());
    if (forth != back) return fmt::format("the faces of the cell of seed {} leave a gap", i);
  }
  return {};
}

/// Numbers of the vertices of joined cells. They have the coordinates of the pieces' vertices.
class JoinedNumbers {
 public:
  JoinedNumbers(const DiagramOutput& output, const SharedPoints& points)
      : cells_(output.cells), joined_(output.joined), points_(points) {}

  std::vector<std::uint32_t> of_cell(std::size_t cell) {
    const auto d = static_cast<std::size_t>(cells_.dimension);
    known_.clear();
    for (std::uint64_t v = cells_.vertex_offset[cells_.cell_offset[cell]];
         v < cells_.vertex_offset[cells_.cell_offset[cell + 1]]; ++v)
      known_.emplace_back(place(&cells_.vertices[v * d]), points_.number[v]);
    std::sort(known_.begin(), known_.end());
    std::vector<std::uint32_t> numbers;
    for (std::uint64_t v = joined_.vertex_offset[cell]; v < joined_.vertex_offset[cell + 1]; ++v) {
      const auto found =
          std::lower_bound(known_.begin(), known_.end(), std::pair(place(&joined_.vertices[v * d]), 0U));
      if (found == known_.end() || found->first != place(&joined_.vertices[v * d]))
        throw Error(ErrorCode::internal,
                    fmt::format("the joined cell of seed {} has a vertex of its own", cell));
      numbers.push_back(found->second);
    }
    return numbers;
  }

 private:
  using Place = std::array<double, 3>;
  Place place(const double* at) const { return {at[0], at[1], cells_.dimension == 3 ? at[2] : 0.0}; }

  const Cells& cells_;
  const JoinedCells& joined_;
  const SharedPoints& points_;
  std::vector<std::pair<Place, std::uint32_t>> known_;
};

/// Adds a face without edges that have no length.
void add_ring(SharedCells& shared, const JoinedCells& joined, std::uint64_t f,
              const std::vector<std::uint32_t>& number) {
  const std::uint64_t begin = joined.loop_offset[f], n = joined.loop_offset[f + 1] - begin;
  const std::size_t before = shared.loop.size();
  for (std::uint64_t k = 0; k < n; ++k) {
    const std::uint64_t e = begin + k;
    if (number[joined.loop[e]] == number[joined.loop[begin + (k + 1) % n]]) continue;
    shared.loop.push_back(number[joined.loop[e]]);
    shared.edge_border.push_back(joined.edge_border[e]);
    if (!joined.shift.empty()) shared.shift.push_back(joined.shift[e]);
  }
  if (shared.loop.size() < before + 3) {
    shared.loop.resize(before);
    shared.edge_border.resize(before);
    if (!joined.shift.empty()) shared.shift.resize(before);
    return;
  }
  shared.loop_offset.push_back(shared.loop.size());
}

void add_polygons(SharedCells& shared, const DiagramOutput& output, const SharedPoints& points) {
  JoinedNumbers numbers(output, points);
  const JoinedCells& joined = output.joined;
  for (std::size_t i = 0; i + 1 < joined.face_offset.size(); ++i) {
    const std::vector<std::uint32_t> number = numbers.of_cell(i);
    for (std::uint64_t f = joined.face_offset[i]; f < joined.face_offset[i + 1]; ++f)
      add_ring(shared, joined, f, number);
    shared.face_offset.push_back(shared.face_count());
  }
}

/// Each edge between two cells must be in both, with the same ends.
std::string fault_of_polygons(const SharedCells& shared) {
  std::map<std::tuple<std::uint32_t, std::uint32_t, PointPair>, int>
      sides;  // seeds, ends; of the lower seed minus the other
  for (std::uint32_t i = 0; i < shared.cell_count(); ++i)
    for (std::uint64_t f = shared.face_offset[i]; f < shared.face_offset[i + 1]; ++f) {
      const auto loop = shared.face(f);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint64_t e = shared.loop_offset[f] + k;
        const Border& border = shared.edge_border[e];
        if (border.kind != Border::Kind::wall || (!shared.shift.empty() && shared.shift[e] != no_shift))
          continue;
        const std::uint32_t a = loop[k], b = loop[(k + 1) % loop.size()];
        if (i < border.index)
          ++sides[{i, border.index, {std::min(a, b), std::max(a, b)}}];
        else
          --sides[{border.index, i, {std::min(a, b), std::max(a, b)}}];
      }
    }
  for (const auto& [edge, sum] : sides)
    if (sum != 0)
      return fmt::format("the cells of the seeds {} and {} differ at their wall", std::get<0>(edge),
                         std::get<1>(edge));
  return {};
}

/// Drops points that no face uses.
void drop_unused(SharedCells& shared, const SharedPoints& points) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> number(points.size(), none);
  for (std::uint32_t& p : shared.loop) {
    if (number[p] == none) {
      number[p] = static_cast<std::uint32_t>(shared.point_count());
      shared.points.insert(shared.points.end(), points.point(p), points.point(p) + 3);
    }
    p = number[p];
  }
}

}  // namespace

std::vector<std::uint32_t> SharedCells::points_of(std::size_t cell) const {
  const auto begin = static_cast<std::ptrdiff_t>(loop_offset[face_offset[cell]]),
             end = static_cast<std::ptrdiff_t>(loop_offset[face_offset[cell + 1]]);
  std::vector<std::uint32_t> sorted(loop.begin() + begin, loop.begin() + end), used;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  std::vector<std::uint8_t> seen(sorted.size());
  for (std::ptrdiff_t e = begin; e < end; ++e) {
    const std::uint32_t p = loop[static_cast<std::size_t>(e)];
    const auto at =
        static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), p) - sorted.begin());
    if (!std::exchange(seen[at], 1)) used.push_back(p);
  }
  return used;
}

SharedCells share_cells(const DiagramOutput& output) {
  SharedCells shared;
  start_cells(shared, output);
  const SharedPoints points = share_points(output);
  if (shared.cell_dimension == 3)
    add_volumes(shared, shared_walls(output, points), output.measures.mass.size(),
                output.domain.is_periodic());
  else
    add_polygons(shared, output, points);
  drop_unused(shared, points);
  shared.fault = shared.cell_dimension == 3 ? fault_of_volumes(shared) : fault_of_polygons(shared);
  return shared;
}

SharedCells separate_cells(const DiagramOutput& output, std::string fault) {
  const JoinedCells& joined = output.joined;
  SharedCells separate;
  start_cells(separate, output);
  separate.fault = std::move(fault);
  const auto d = static_cast<std::size_t>(joined.dimension);
  for (std::size_t v = 0; d > 0 && v < joined.vertices.size(); v += d)
    for (std::size_t k = 0; k < 3; ++k) separate.points.push_back(k < d ? joined.vertices[v + k] : 0.0);
  for (std::size_t i = 0; i + 1 < joined.face_offset.size(); ++i)
    for (std::uint64_t e = joined.loop_offset[joined.face_offset[i]];
         e < joined.loop_offset[joined.face_offset[i + 1]]; ++e)
      separate.loop.push_back(static_cast<std::uint32_t>(joined.vertex_offset[i] + joined.loop[e]));
  separate.face_offset = joined.face_offset;
  separate.loop_offset = joined.loop_offset;
  separate.face_border = joined.face_border;
  separate.edge_border = joined.edge_border;
  separate.shift = joined.shift;
  return separate;
}

SharedCells fitting_cells(const std::string& path, const DiagramOutput& output) {
  SharedCells shared = share_cells(output);
  if (!shared.fault.empty())
    throw Error(
        ErrorCode::write_failed,
        path + ": " + shared.fault +
            ", so the cells cannot share their walls; compute in double precision with exact decisions "
            "(--precision double --decisions exact), or write .vtp or .obj, whose faces share nothing");
  return shared;
}

}  // namespace powercell::io
