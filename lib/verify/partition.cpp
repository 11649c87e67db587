#include "lib/verify/partition.hpp"

#include <algorithm>

#include "lib/base/text.hpp"
#include "lib/domain/measure.hpp"
#include "lib/verify/angles.hpp"
#include "lib/verify/laws.hpp"

namespace powercell {
namespace {

/// Reach times gradient over measure, for a cube and a seed in its corner.
constexpr double usual_ratio = 6;

/// Gradients of the measure with respect to all corners, summed over the regions.
class Gradients {
 public:
  explicit Gradients(const RegionMesh& mesh)
      : mesh_(mesh), sums_(mesh.vertices.size() / static_cast<std::size_t>(mesh.dimension)) {
    for (std::size_t r = 0; r < mesh.region_count(); ++r) add_region(r);
  }
  /// Of the volume inside the triangles of a surface.
  static Gradients of_inside(const RegionMesh& boundary) {
    Gradients gradients(boundary, boundary.vertices.size() / 3);
    for (std::size_t t = 0; t < boundary.region_vertex.size(); t += 3) {
      const std::uint32_t* corner = &boundary.region_vertex[t];
      const Vector normal = cross(gradients.edge(corner[0], corner[1]), gradients.edge(corner[0], corner[2]));
      for (std::size_t k = 0; k < 3; ++k) gradients.add(corner[k], 1 / 6.0L, normal);
    }
    return gradients;
  }

  long double sum_of_lengths() const {
    long double sum = 0;
    for (const Vector& gradient : sums_) sum += std::sqrt(dot(gradient, gradient));
    return sum;
  }

 private:
  Gradients(const RegionMesh& mesh, std::size_t vertices) : mesh_(mesh), sums_(vertices) {}

  Vector edge(std::uint32_t from, std::uint32_t to) const {
    const auto d = static_cast<std::size_t>(mesh_.dimension);
    const double *a = &mesh_.vertices[from * d], *b = &mesh_.vertices[to * d];
    if (d == 3) return difference<long double>(b, a);
    return {static_cast<long double>(b[0]) - a[0], static_cast<long double>(b[1]) - a[1], 0};
  }

  void add(std::uint32_t vertex, long double factor, const Vector& part) {
    for (std::size_t k = 0; k < 3; ++k) sums_[vertex][k] += factor * part[k];
  }

  void add_region(std::size_t r) {
    const std::uint32_t* corner = &mesh_.region_vertex[mesh_.region_offset[r]];
    if (mesh_.shape == RegionShape::polygon) {
      add_polygon(corner, mesh_.region_offset[r + 1] - mesh_.region_offset[r]);
    } else if (mesh_.shape == RegionShape::tetrahedron) {
      add_tetrahedron(corner);
    } else {
      add_box(corner);
    }
  }

  /// Half the segment between the neighbouring corners, rotated outwards in the plane.
  void add_polygon(const std::uint32_t* corner, std::size_t count) {
    Vector normal{};
    for (std::size_t k = 2; k < count; ++k) {
      const Vector area = cross(edge(corner[0], corner[k - 1]), edge(corner[0], corner[k]));
      for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += area[axis];
    }
    const long double length = std::sqrt(dot(normal, normal));
    if (!(length > 0)) return;
    for (long double& x : normal) x /= length;
    for (std::size_t k = 0; k < count; ++k) {
      const Vector across = edge(corner[(k + count - 1) % count], corner[(k + 1) % count]);
      add(corner[k], 0.5L, cross(across, normal));
    }
  }

  /// A third of the area vector of the opposite facet, directed towards the corner.
  void add_tetrahedron(const std::uint32_t* corner) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& [a, b, c] = tetrahedron_facet[k];
      add(corner[k], 1 / 6.0L, cross(edge(corner[a], corner[c]), edge(corner[a], corner[b])));
    }
  }

  /// A quarter of the area vectors of its three facets.
  void add_box(const std::uint32_t* corner) {
    const Vector x = edge(corner[0], corner[1]), y = edge(corner[0], corner[2]),
                 z = edge(corner[0], corner[4]);
    const Vector area{y[1] * z[2], x[0] * z[2], x[0] * y[1]};
    for (std::size_t k = 0; k < 8; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        sums_[corner[k]][axis] += (k >> axis & 1 ? 0.25L : -0.25L) * area[axis];
  }

  const RegionMesh& mesh_;
  std::vector<Vector> sums_;
};

/// Masses are sums over cells whose shared faces move alike, so the error of the total does not grow with
/// their number.
constexpr double partition_double = 1e-12, partition_float = 1e-5;

/// The greatest distance from a seed with a cell to the domain.
double greatest_reach(const Measures& measures, const Rounding& rounding) {
  double reach = 0;
  for (std::size_t i = 0; i < measures.mass.size(); ++i)
    if (measures.status[i] == SeedStatus::ok) reach = std::max(reach, rounding.reach(i));
  return reach;
}

/// The domain's boundary by the cells: the length of each edge, or the area of each face, times the distance
/// from its seed to its farthest corner.
long double boundary_times_reach(const Cells& cells, const Rounding& rounding) {
  long double sum = 0;
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
        if (cells.border[f].kind != Border::Kind::boundary) continue;
        const std::vector<Vector> corners = face_corners(cells, p, f);
        long double reach = 0;
        for (const Vector& corner : corners) reach = std::max(reach, norm(corner - rounding.position(i)));
        sum += face_measure(corners) * reach;
      }
  return sum;
}

/// The tolerance for one piece; for each of its walls at most the area of its triangle.
long double slanted_area(const Cells& cells, std::size_t seed, std::uint64_t piece, const Corners& triangle,
                         const Rounding& rounding) {
  const Vector normal = normal_of(triangle);
  const long double most = norm(normal) / 2;
  long double sum = 0;
  for (std::uint64_t f = cells.face_offset[piece]; f < cells.face_offset[piece + 1]; ++f) {
    if (cells.border[f].kind != Border::Kind::wall) continue;
    const std::uint32_t other = cells.border[f].index;
    const std::vector<Vector> end = face_corners(cells, piece, f);
    const long double area = norm(end[1] - end[0]) * rounding.wall_shift(seed, other);
    const long double sine = sine_between(rounding.position(other) - rounding.position(seed), normal);
    sum += area < most * sine ? area / sine : most;
  }
  return sum;
}

}  // namespace

long double measure_gradient(const RegionMesh& mesh) {
  return (mesh.solid_boundary ? Gradients::of_inside(*mesh.solid_boundary) : Gradients(mesh))
      .sum_of_lengths();
}

double partition_tolerance(const RegionMesh& mesh, double usual, double reach) {
  const long double ratio = reach * measure_gradient(mesh) / mesh.measure;
  return static_cast<double>(usual * std::max(1.0L, ratio / usual_ratio));
}

long double slanted_area(const Cells& cells, const RegionMesh& mesh, const Rounding& rounding) {
  long double sum = 0;
  if (mesh.kind != DomainKind::surface) return sum;
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
      sum += slanted_area(cells, i, p, corners_of(mesh, cells.region[p]), rounding);
  return sum;
}

LawCheck check_partition(const Measures& measures, const Cells& cells, const RegionMesh* mesh,
                         const Rounding& rounding) {
  const double usual = rounding.unit() == 0x1p-24 ? partition_float : partition_double;
  const double error = measures.mass.empty() ? 0 : measures.relative_error();  // no seeds have no cells
  double tolerance = usual;
  if (mesh != nullptr) {
    tolerance = partition_tolerance(*mesh, usual, greatest_reach(measures, rounding));
    if (error > tolerance)
      tolerance += static_cast<double>(slanted_area(cells, *mesh, rounding)) / measures.domain_measure;
  } else if (error > tolerance) {
    tolerance += 2 * rounding.unit() * static_cast<double>(boundary_times_reach(cells, rounding)) /
                 measures.domain_measure;
  }
  LawCheck check{
      "partition: the measures sum to the domain's (relative)", error <= tolerance, error, tolerance, {}};
  if (!check.passed)
    check.detail = "the cells sum to " + digits(measures.total()) + ", the domain has " +
                   digits(measures.domain_measure);
  return check;
}

}  // namespace powercell
