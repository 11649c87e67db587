#include "lib/applications/transport/cell_simplices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/base/vectors.hpp"

namespace powercell {
namespace {

using Point = Vector3<double>;

double measure(const CellSimplices& all, const CellSimplex& s) {
  const Point& at = all.vertex[s.vertex[0]];
  const Point n = cross(all.vertex[s.vertex[1]] - at, all.vertex[s.vertex[2]] - at);
  return s.corners == 3 ? norm(n) / 2 : std::fabs(dot(n, all.vertex[s.vertex[3]] - at)) / 6;
}

/// Simplices of one piece: fans from its first vertex.
template <class Add>
void cut_piece(const Cells& cells, std::uint64_t piece, const Add& add) {
  const auto base = static_cast<std::uint32_t>(cells.vertex_offset[piece]),
             end = static_cast<std::uint32_t>(cells.vertex_offset[piece + 1]);
  if (cells.cell_dimension == 2) {
    for (std::uint32_t v = base + 2; v < end; ++v) add({base, v - 1, v, 0}, 3);
    return;
  }
  for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f)
    for (std::uint64_t k = cells.loop_offset[f] + 2; k < cells.loop_offset[f + 1]; ++k)
      add({base, base + cells.loop[cells.loop_offset[f]], base + cells.loop[k - 1], base + cells.loop[k]}, 4);
}

double cube(double x) {
  return x * x * x;
}

}  // namespace

CellSimplices cut_into_simplices(const Cells& cells, std::span<const double> mass) {
  CellSimplices all;
  const auto d = static_cast<std::size_t>(cells.dimension);
  all.owner.resize(cells.vertices.size() / d);
  all.vertex.resize(all.owner.size());
  for (std::size_t v = 0; v < all.owner.size(); ++v)
    std::copy_n(&cells.vertices[v * d], d, all.vertex[v].begin());
  for (std::uint32_t i = 0; i < cells.cell_count(); ++i) {
    const std::size_t first = all.simplex.size();
    double sum = 0;
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      for (std::uint64_t v = cells.vertex_offset[p]; v < cells.vertex_offset[p + 1]; ++v) all.owner[v] = i;
      cut_piece(cells, p, [&](const std::array<std::uint32_t, 4>& vertex, int corners) {
        CellSimplex simplex{i, vertex, corners, 0};
        simplex.mass = measure(all, simplex);
        sum += simplex.mass;
        all.simplex.push_back(simplex);
      });
    }
    for (std::size_t k = first; k < all.simplex.size(); ++k)
      all.simplex[k].mass *= sum > 0 ? mass[i] / sum : 0;
  }
  return all;
}

double share_below(std::array<double, 4> value, int corners, double t) {
  if (corners == 3) value[3] = std::numeric_limits<double>::infinity();
  std::ranges::sort(value);
  const auto last = static_cast<std::size_t>(corners - 1);
  if (t <= value[0]) return 0;
  if (t >= value[last]) return 1;
  // Equal values would divide by zero; the share is continuous in them.
  const double apart = 1e-7 * (value[last] - value[0]);
  for (std::size_t k = 1; k <= last; ++k) value[k] = std::max(value[k], value[k - 1] + apart);
  const auto& [a, b, c, e] = value;
  if (corners == 3) {
    if (t <= b) return (t - a) * (t - a) / ((b - a) * (c - a));
    return 1 - (c - t) * (c - t) / ((c - a) * (c - b));
  }
  if (t <= b) return cube(t - a) / ((b - a) * (c - a) * (e - a));
  if (t >= c) return 1 - cube(e - t) / ((e - a) * (e - b) * (e - c));
  const double between =
      cube(t - a) / ((b - a) * (c - a) * (e - a)) - cube(t - b) / ((b - a) * (c - b) * (e - b));
  return std::clamp(between, 0.0, 1.0);
}

}  // namespace powercell
