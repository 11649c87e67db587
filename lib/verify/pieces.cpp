#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/base/text.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

struct Sums {
  long double measure = 0, surface = 0, extent = 0;  // extent: farthest vertex from the seed
  Vector first{};                                    // moment about the seed

  /// \param direction  unit normal of the piece: triangles that run the other way count negative
  void add_triangle(const Vector& a, const Vector& b, const Vector& c, const Vector& direction) {
    add(dot(cross(b - a, c - a), direction) / 2, a + b + c, 3);
  }
  void add_tetrahedron(const Vector& apex, const Vector& a, const Vector& b, const Vector& c) {
    add(dot(a - apex, cross(b - apex, c - apex)) / 6, apex + a + b + c, 4);
  }

 private:
  void add(long double part, const Vector& corners, int count) {
    measure += part;
    first = first + (part / count) * corners;
  }
};

/// Rounding of the sums of products of vertices.
double rounding_of(const Sums& sums, int power) {
  return static_cast<double>(64 * std::numeric_limits<long double>::epsilon() * std::pow(sums.extent, power));
}

void add_polygon(const Cells& cells, std::uint64_t piece, const Vector& seed, Sums& sums) {
  std::vector<Vector> corner;
  for (std::uint64_t v = cells.vertex_offset[piece]; v < cells.vertex_offset[piece + 1]; ++v)
    corner.push_back(cell_vertex(cells, v) - seed);
  Vector direction = cells.dimension == 2 ? Vector{0, 0, 1} : twice_area(corner);
  if (const long double size = norm(direction); size > 0) direction = (1 / size) * direction;
  for (std::size_t k = 0; k < corner.size(); ++k) {
    const Vector &a = corner[k], &b = corner[(k + 1) % corner.size()];
    sums.surface += norm(b - a);
    sums.extent = std::max(sums.extent, norm(a));
    sums.add_triangle(corner[0], a, b, direction);
  }
}

void add_polyhedron(const Cells& cells, std::uint64_t piece, const Vector& seed, Sums& sums) {
  if (cells.face_offset[piece] == cells.face_offset[piece + 1]) return;
  const Vector apex = cell_vertex(cells, cells.vertex_offset[piece]) - seed;
  for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f) {
    std::vector<Vector> corner = face_corners(cells, piece, f);
    for (Vector& x : corner) {
      x = x - seed;
      sums.extent = std::max(sums.extent, norm(x));
    }
    for (std::size_t k = 2; k < corner.size(); ++k) {
      sums.surface += norm(cross(corner[k - 1] - corner[0], corner[k] - corner[0])) / 2;
      sums.add_tetrahedron(apex, corner[0], corner[k - 1], corner[k]);
    }
  }
}

Sums sums_of(const Cells& cells, std::size_t i, const Vector& seed) {
  Sums sums;
  for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
    if (cells.cell_dimension == 2) {
      add_polygon(cells, p, seed, sums);
    } else {
      add_polyhedron(cells, p, seed, sums);
    }
  }
  return sums;
}

}  // namespace

std::vector<Vector> face_corners(const Cells& cells, std::size_t piece, std::uint64_t face) {
  const std::uint64_t begin = cells.vertex_offset[piece], end = cells.vertex_offset[piece + 1];
  std::vector<Vector> corners;
  if (cells.cell_dimension == 2) {
    const std::uint64_t a = begin + (face - cells.face_offset[piece]);
    corners = {cell_vertex(cells, a), cell_vertex(cells, a + 1 < end ? a + 1 : begin)};
  } else {
    for (std::uint64_t k = cells.loop_offset[face]; k < cells.loop_offset[face + 1]; ++k)
      corners.push_back(cell_vertex(cells, begin + cells.loop[k]));
  }
  return corners;
}

Vector twice_area(const std::vector<Vector>& corners) {
  Vector sum{};
  for (std::size_t k = 2; k < corners.size(); ++k)
    sum = sum + cross(corners[k - 1] - corners[0], corners[k] - corners[0]);
  return sum;
}

long double face_measure(const std::vector<Vector>& corners) {
  return corners.size() == 2 ? norm(corners[1] - corners[0]) : norm(twice_area(corners)) / 2;
}

std::vector<LawCheck> check_pieces(const Measures& measures, const Cells& cells, const Rounding& rounding) {
  Worst mass, centroid;
  const auto d = static_cast<std::size_t>(measures.dimension);
  const bool has_centroids = measures.centroid.size() == measures.mass.size() * d;
  for (std::size_t i = 0; i < measures.mass.size(); ++i) {
    const Vector seed = rounding.position(i);
    const Sums sums = sums_of(cells, i, seed);
    // Moving the faces of a cell by the rounding of its planes changes its measure by that times its surface,
    // and a cell as small as the rounding may vanish. Beside that the sum here has its own rounding, which
    // counts where a needle is far longer than thick.
    const double moved = rounding.shift(i) * static_cast<double>(sums.surface) +
                         std::pow(rounding.shift(i), cells.cell_dimension) +
                         rounding_of(sums, cells.cell_dimension) +
                         rounding.least_measure(cells.cell_dimension);
    const double given = measures.mass[i];
    mass.see(std::abs(static_cast<double>(sums.measure - given)), moved, [&] {
      return "seed " + std::to_string(i) + " has measure " + digits(given) + ", its " +
             std::to_string(cells.cell_offset[i + 1] - cells.cell_offset[i]) + " pieces sum to " +
             digits(static_cast<double>(sums.measure));
    });
    if (!has_centroids || !(given > 0) || !(sums.measure > 0)) continue;
    const double* c = &measures.centroid[i * d];
    const Vector given_centroid = Vector{c[0], c[1], d == 3 ? c[2] : 0.0} - seed;
    const double apart = static_cast<double>(norm(given_centroid - (1 / sums.measure) * sums.first));
    const double allowed = rounding.shift(i) + moved * static_cast<double>(sums.extent / sums.measure);
    centroid.see(apart, allowed, [&] {
      return "the centroid of seed " + std::to_string(i) + " is " + digits(apart, 3) +
             " from that of its pieces";
    });
  }
  const double usual = rounding.unit() * rounding.diagonal();
  std::vector<LawCheck> checks{mass.result("pieces: those of each cell sum to its measure", usual)};
  if (has_centroids) checks.push_back(centroid.result("centroids: each is that of the cell's pieces", usual));
  return checks;
}

}  // namespace powercell
