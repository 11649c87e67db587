#include "lib/collect/dual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include "lib/domain/orientation.hpp"

namespace powercell {

namespace {

template <std::size_t C>
using Simplex = std::array<std::uint32_t, C>;

/// The seeds of a row in ascending order.
/// \pre a row starts with its smallest seed
Simplex<3> key(const Simplex<3>& row) {
  return row[1] < row[2] ? row : Simplex<3>{row[0], row[2], row[1]};
}
Simplex<4> key(const Simplex<4>& row) {
  return row;
}

template <std::size_t C>
bool by_key(const Simplex<C>& a, const Simplex<C>& b) {
  return key(a) < key(b);
}

template <std::size_t C>
void keep_distinct(std::vector<Simplex<C>>& rows, std::size_t begin) {
  const auto first = rows.begin() + static_cast<std::ptrdiff_t>(begin);
  if constexpr (C == 3) {
    std::stable_sort(first, rows.end(), by_key<C>);  // the first one found determines the orientation
  } else {
    std::sort(first, rows.end(), by_key<C>);
  }
  rows.erase(std::unique(first, rows.end(), [](const auto& a, const auto& b) { return key(a) == key(b); }),
             rows.end());
}

bool is_wall(const Border& border) {
  return border.kind == Border::Kind::wall;
}

/// Calls `found` with the triangle of each vertex of a polygonal piece between two walls. The cell lies to
/// the left of its edges, so the counter-clockwise order around the vertex is: the cell, the neighbour across
/// the edge that ends there, the neighbour across the edge that starts there.
template <class Found>
void corners_of_polygon(const Cells& cells, std::uint32_t cell, std::size_t piece, const Found& found) {
  const std::uint64_t begin = cells.face_offset[piece], end = cells.face_offset[piece + 1];
  for (std::uint64_t k = begin; k < end; ++k) {
    const Border& in = cells.border[k == begin ? end - 1 : k - 1];
    const Border& out = cells.border[k];
    if (!is_wall(in) || !is_wall(out) || in.index == out.index) continue;
    Simplex<3> row{cell, in.index, out.index};
    std::rotate(row.begin(), std::min_element(row.begin(), row.end()), row.end());
    found(row);
  }
}

/// Scratch memory: the walls at each vertex of a polyhedral piece.
struct Incidence {
  std::vector<std::array<std::uint32_t, 3>> wall;  ///< neighbours across the first three walls
  std::vector<std::uint32_t> count;                ///< number of walls
};

/// Calls `found` with the tetrahedron of each vertex of a polyhedral piece where three walls meet.
template <class Found>
void corners_of_polyhedron(const Cells& cells, std::uint32_t cell, std::size_t piece, Incidence& around,
                           const Found& found) {
  const std::size_t vertices = cells.vertex_offset[piece + 1] - cells.vertex_offset[piece];
  around.wall.resize(std::max(around.wall.size(), vertices));
  around.count.assign(vertices, 0);
  for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f) {
    if (!is_wall(cells.border[f])) continue;
    for (std::uint64_t k = cells.loop_offset[f]; k < cells.loop_offset[f + 1]; ++k) {
      const std::uint32_t v = cells.loop[k];
      if (around.count[v] < 3) around.wall[v][around.count[v]] = cells.border[f].index;
      ++around.count[v];
    }
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    if (around.count[v] != 3) continue;
    Simplex<4> row{cell, around.wall[v][0], around.wall[v][1], around.wall[v][2]};
    std::sort(row.begin(), row.end());
    if (std::adjacent_find(row.begin(), row.end()) == row.end()) found(row);
  }
}

/// False if a seed of the row is hidden. Cells may have edges of length 0 with such a seed, where its
/// bisector contains a facet of the boundary.
template <std::size_t C>
bool all_have_cells(const Cells& cells, const Simplex<C>& row) {
  return std::all_of(row.begin(), row.end(), [&](std::uint32_t seed) {
    return cells.cell_offset[seed] < cells.cell_offset[std::size_t{seed} + 1];
  });
}

template <std::size_t C, class Found>
void corners_of_cell(const Cells& cells, std::uint32_t cell, Incidence& around, const Found& any) {
  const auto found = [&](const Simplex<C>& row) {
    if (all_have_cells(cells, row)) any(row);
  };
  for (std::uint64_t p = cells.cell_offset[cell]; p < cells.cell_offset[cell + 1]; ++p) {
    if constexpr (C == 3) {
      corners_of_polygon(cells, cell, p, found);
    } else {
      corners_of_polyhedron(cells, cell, p, around, found);
    }
  }
}

/// Rows by ascending key. The cell of a simplex's smallest seed nearly always has its corner, so a first pass
/// takes simplices from there, which are then sorted already. It lacks corners on the border between two of
/// its regions; a second pass takes those from the other cells.
template <std::size_t C>
std::vector<Simplex<C>> collect(const Cells& cells) {
  const std::uint32_t n = static_cast<std::uint32_t>(cells.cell_count());
  std::vector<Simplex<C>> rows;
  std::vector<std::uint64_t> offset(std::size_t{n} + 1, 0);
  Incidence around;
  for (std::uint32_t i = 0; i < n; ++i) {
    corners_of_cell<C>(cells, i, around, [&](const Simplex<C>& row) {
      if (row[0] == i) rows.push_back(row);
    });
    keep_distinct(rows, offset[i]);
    offset[std::size_t{i} + 1] = rows.size();
  }
  std::vector<Simplex<C>> missed;
  for (std::uint32_t i = 0; i < n; ++i) {
    corners_of_cell<C>(cells, i, around, [&](const Simplex<C>& row) {
      if (row[0] == i) return;
      const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(offset[row[0]]);
      const auto end = rows.begin() + static_cast<std::ptrdiff_t>(offset[std::size_t{row[0]} + 1]);
      if (!std::binary_search(begin, end, row, by_key<C>)) missed.push_back(row);
    });
  }
  if (!missed.empty()) {
    keep_distinct(missed, 0);
    const auto middle = static_cast<std::ptrdiff_t>(rows.size());
    rows.insert(rows.end(), missed.begin(), missed.end());
    std::inplace_merge(rows.begin(), rows.begin() + middle, rows.end(), by_key<C>);
  }
  return rows;
}

/// Orients each row positively by the positions of its seeds. Differences in long double are exact unless
/// positions differ in scale by more than its extra bits. If the determinant is below `rounding` times the
/// product of the edge lengths, its sign is computed exactly.
template <std::size_t C>
void orient(std::vector<Simplex<C>>& rows, const SeedsView& seeds) {
  constexpr std::size_t d = C - 1;
  constexpr long double rounding = 16 * std::numeric_limits<long double>::epsilon();
  for (Simplex<C>& row : rows) {
    long double e[d][d], scale = rounding;
    for (std::size_t k = 0; k < d; ++k) {
      long double squared = 0;
      for (std::size_t c = 0; c < d; ++c) {
        e[k][c] =
            static_cast<long double>(seeds.positions[d * row[k + 1] + c]) - seeds.positions[d * row[0] + c];
        squared += e[k][c] * e[k][c];
      }
      scale *= std::sqrt(squared);
    }
    long double det;
    if constexpr (d == 2) {
      det = e[0][0] * e[1][1] - e[0][1] * e[1][0];
    } else {
      det = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    }
    const bool negative = det < -scale || (det <= scale && exact_orientation(seeds.positions, row) < 0);
    if (negative) std::swap(row[d - 1], row[d]);
  }
}

template <std::size_t C>
Dual finish(std::vector<Simplex<C>> rows) {
  // Orientation changed the order only among rows with the same smallest seed.
  for (auto begin = rows.begin(); begin != rows.end();) {
    const auto end =
        std::find_if(begin, rows.end(), [&](const Simplex<C>& row) { return row[0] != (*begin)[0]; });
    std::sort(begin, end);
    begin = end;
  }
  Dual dual;
  dual.corners = C;
  dual.simplices.reserve(C * rows.size());
  for (const Simplex<C>& row : rows) dual.simplices.insert(dual.simplices.end(), row.begin(), row.end());
  return dual;
}

/// All rows start ascending; orient() may exchange their last two seeds.
template <std::size_t C>
Dual extended(const Dual& dual, const std::vector<std::uint32_t>& more, const SeedsView& seeds) {
  std::vector<Simplex<C>> rows;
  rows.reserve((dual.simplices.size() + more.size()) / C);
  for (const std::vector<std::uint32_t>* from : {&dual.simplices, &more})
    for (std::size_t at = 0; at < from->size(); at += C) {
      Simplex<C> row;
      std::copy_n(from->begin() + static_cast<std::ptrdiff_t>(at), C, row.begin());
      std::sort(row.begin(), row.end());
      rows.push_back(row);
    }
  keep_distinct(rows, 0);
  orient(rows, seeds);
  return finish(std::move(rows));
}

}  // namespace

std::vector<std::uint32_t> corners_of_cells(const Cells& cells) {
  std::vector<std::uint32_t> rows;
  Incidence around;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      corners_of_polyhedron(cells, i, p, around,
                            [&](const Simplex<4>& row) { rows.insert(rows.end(), row.begin(), row.end()); });
  return rows;
}

Dual extend_dual(const Dual& dual, const std::vector<std::uint32_t>& rows, const SeedsView& seeds) {
  return dual.corners == 3 ? extended<3>(dual, rows, seeds) : extended<4>(dual, rows, seeds);
}

Dual make_dual(const Cells& cells, const SeedsView& seeds) {
  if (cells.cell_dimension == 3) {
    std::vector<Simplex<4>> rows = collect<4>(cells);
    orient(rows, seeds);
    return finish(std::move(rows));
  }
  std::vector<Simplex<3>> rows = collect<3>(cells);
  if (cells.dimension == 2) orient(rows, seeds);
  return finish(std::move(rows));
}

namespace {

struct Corner {
  std::uint32_t seed;
  std::array<std::int32_t, 3> shift;
  friend std::strong_ordering operator<=>(const Corner&, const Corner&) = default;
};
template <std::size_t C>
using CornerRow = std::array<Corner, C>;

/// The row moved so that `origin` has the shift 0, with its corners ascending.
template <std::size_t C>
CornerRow<C> moved(CornerRow<C> row, const Corner& origin) {
  const std::array<std::int32_t, 3> by = origin.shift;
  for (Corner& corner : row)
    for (std::size_t k = 0; k < 3; ++k) corner.shift[k] -= by[k];
  std::sort(row.begin(), row.end());
  return row;
}

/// The same row for all images of a simplex: the first of those in which an image of the smallest seed has
/// the shift 0.
template <std::size_t C>
CornerRow<C> canonical(const CornerRow<C>& row) {
  const std::uint32_t least = std::min_element(row.begin(), row.end(), [](const Corner& a, const Corner& b) {
                                return a.seed < b.seed;
                              })->seed;
  bool found = false;
  CornerRow<C> best{};
  for (const Corner& origin : row) {
    if (origin.seed != least) continue;
    const CornerRow<C> here = moved(row, origin);
    if (found && !(here < best)) continue;
    found = true;
    best = here;
  }
  std::rotate(
      best.begin(),
      std::find_if(best.begin(), best.end(),
                   [&](const Corner& c) { return c.seed == least && c.shift == decltype(c.shift){}; }),
      best.end());
  std::sort(best.begin() + 1, best.end());
  return best;
}

/// The corners of one piece: calls found(row) where enough walls meet.
template <std::size_t C, class Found>
void corners_of_piece(const Cells& cells, std::uint32_t cell, std::uint64_t piece, const Found& found) {
  const std::uint64_t begin = cells.face_offset[piece], end = cells.face_offset[piece + 1];
  const auto is_wall = [&](std::uint64_t f) { return cells.border[f].kind == Border::Kind::wall; };
  const auto across = [&](std::uint64_t f) { return Corner{cells.border[f].index, cells.shift[f]}; };
  if constexpr (C == 3) {
    for (std::uint64_t f = begin; f < end; ++f) {
      const std::uint64_t before = f == begin ? end - 1 : f - 1;
      if (is_wall(before) && is_wall(f)) found(CornerRow<3>{Corner{cell, {}}, across(before), across(f)});
    }
  } else {
    std::vector<std::vector<Corner>> around(cells.vertex_offset[piece + 1] - cells.vertex_offset[piece]);
    for (std::uint64_t f = begin; f < end; ++f)
      for (std::uint64_t k = cells.loop_offset[f]; is_wall(f) && k < cells.loop_offset[f + 1]; ++k)
        around[cells.loop[k]].push_back(across(f));
    for (const std::vector<Corner>& walls : around)
      if (walls.size() == 3) found(CornerRow<4>{Corner{cell, {}}, walls[0], walls[1], walls[2]});
  }
}

/// Exchanges the last two corners of rows whose orientation is negative by more than rounding.
template <std::size_t C>
void orient(CornerRow<C>& row, std::span<const double> positions,
            const std::array<std::array<double, 3>, 3>& periods) {
  constexpr std::size_t d = C - 1;
  long double e[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
              scale = 64 * std::numeric_limits<double>::epsilon();
  for (std::size_t k = 0; k < d; ++k) {
    long double squared = 0;
    for (std::size_t c = 0; c < d; ++c) {
      e[k][c] = static_cast<long double>(positions[d * row[k + 1].seed + c]) - positions[d * row[0].seed + c];
      for (std::size_t axis = 0; axis < d; ++axis)
        e[k][c] += static_cast<long double>(row[k + 1].shift[axis] - row[0].shift[axis]) * periods[axis][c];
      squared += e[k][c] * e[k][c];
    }
    scale *= std::sqrt(squared);
  }
  const long double determinant = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                                  e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                                  e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
  if (determinant < -scale) std::swap(row[C - 2], row[C - 1]);
}

template <std::size_t C>
Dual dual_of(const Cells& cells, std::span<const double> positions,
             const std::array<std::array<double, 3>, 3>& periods) {
  const auto has_cell = [&](const Corner& corner) {
    return cells.cell_offset[corner.seed] < cells.cell_offset[std::size_t{corner.seed} + 1];
  };
  std::vector<CornerRow<C>> rows;
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      corners_of_piece<C>(cells, i, p, [&](const CornerRow<C>& row) {
        if (std::all_of(row.begin(), row.end(), has_cell)) rows.push_back(canonical(row));
      });
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (CornerRow<C>& row : rows) orient(row, positions, periods);
  Dual dual;
  dual.corners = C;
  for (const CornerRow<C>& row : rows)
    for (const Corner& corner : row) {
      dual.simplices.push_back(corner.seed);
      dual.shift.push_back(corner.shift);
    }
  return dual;
}

}  // namespace

Dual make_periodic_dual(const Cells& cells, std::span<const double> positions,
                        const std::array<std::array<double, 3>, 3>& periods) {
  return cells.cell_dimension == 3 ? dual_of<4>(cells, positions, periods)
                                   : dual_of<3>(cells, positions, periods);
}

}  // namespace powercell
