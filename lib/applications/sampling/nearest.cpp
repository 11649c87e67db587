#include "lib/applications/sampling/nearest.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "lib/base/vectors.hpp"

namespace powercell {
namespace {

using Vec = Vector3<double>;

/// The nearest of the points considered so far.
struct Nearest {
  Vec to, point{};
  double squared = std::numeric_limits<double>::infinity();
  void consider(const Vec& x) {
    const double d = dot(x - to, x - to);
    if (d < squared) {
      squared = d;
      point = x;
    }
  }
};

/// Twice the area vector of a polygon.
Vec area_vector(std::span<const Vec> polygon) {
  Vec sum{};
  for (std::size_t k = 2; k < polygon.size(); ++k)
    sum = sum + cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return sum;
}

/// Considers the nearest point of a convex polygon in space or in the plane.
void consider_polygon(std::span<const Vec> polygon, Nearest& nearest) {
  const Vec normal = area_vector(polygon);
  const double squared = dot(normal, normal);
  bool inside = squared > 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec& a = polygon[k];
    const Vec edge = polygon[(k + 1) % polygon.size()] - a;
    if (dot(cross(normal, edge), nearest.to - a) < 0) inside = false;
    const double length2 = dot(edge, edge);
    const double t = length2 > 0 ? std::clamp(dot(nearest.to - a, edge) / length2, 0.0, 1.0) : 0.0;
    nearest.consider(a + t * edge);
  }
  if (inside) nearest.consider(nearest.to + -dot(nearest.to - polygon[0], normal) / squared * normal);
}

class CellView {
 public:
  explicit CellView(const Cells& cells) : cells_(cells), d_(static_cast<std::size_t>(cells.dimension)) {}

  std::vector<Vec> polygon(std::uint64_t piece) const {
    std::vector<Vec> corners;
    for (std::uint64_t v = cells_.vertex_offset[piece]; v < cells_.vertex_offset[piece + 1]; ++v)
      corners.push_back(vertex(v));
    return corners;
  }
  std::vector<Vec> face(std::uint64_t piece, std::uint64_t face) const {
    std::vector<Vec> corners;
    for (std::uint64_t k = cells_.loop_offset[face]; k < cells_.loop_offset[face + 1]; ++k)
      corners.push_back(vertex(cells_.vertex_offset[piece] + cells_.loop[k]));
    return corners;
  }

 private:
  Vec vertex(std::uint64_t v) const {
    const double* x = &cells_.vertices[v * d_];
    return {x[0], x[1], d_ == 3 ? x[2] : 0.0};
  }
  const Cells& cells_;
  std::size_t d_;
};

/// Considers the nearest point of a piece.
void consider_piece(const Cells& cells, std::uint64_t piece, Nearest& nearest) {
  const CellView view(cells);
  if (cells.cell_dimension == 2) return consider_polygon(view.polygon(piece), nearest);
  bool inside = true;
  for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f) {
    const std::vector<Vec> face = view.face(piece, f);
    if (dot(area_vector(face), nearest.to - face[0]) > 0) inside = false;
    consider_polygon(face, nearest);
  }
  if (inside) nearest.consider(nearest.to);
}

}  // namespace

Vec nearest_in_polygon(std::span<const Vec> polygon, const Vec& x) {
  Nearest nearest{x};
  consider_polygon(polygon, nearest);
  return nearest.point;
}

std::array<double, 3> nearest_in_piece(const Cells& cells, std::uint64_t piece,
                                       const std::array<double, 3>& x) {
  Nearest nearest{x};
  consider_piece(cells, piece, nearest);
  return nearest.point;
}

std::array<double, 3> nearest_in_cell(const Cells& cells, std::size_t cell, const std::array<double, 3>& x) {
  Nearest nearest{x};
  for (std::uint64_t p = cells.cell_offset[cell]; p < cells.cell_offset[cell + 1]; ++p)
    consider_piece(cells, p, nearest);
  return nearest.point;
}

}  // namespace powercell
