#include "lib/collect/periodic_dual.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

namespace powercell {
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
