#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <powercell/regions.hpp>

#include "lib/applications/transport/diagram_evaluator.hpp"

namespace powercell {
namespace {

using Vec3 = Eigen::Vector3d;

Vec3 point(const double* x) {
  return {x[0], x[1], x[2]};
}

/// Unit normals of the triangles.
std::vector<Vec3> normals(const RegionsView& mesh) {
  std::vector<Vec3> result(mesh.size());
  for (std::size_t r = 0; r < result.size(); ++r) {
    const std::uint32_t* corner = &mesh.region_vertex[mesh.region_offset[r]];
    const Vec3 a = point(&mesh.vertices[corner[0] * std::size_t{3}]);
    result[r] = (point(&mesh.vertices[corner[1] * std::size_t{3}]) - a)
                    .cross(point(&mesh.vertices[corner[2] * std::size_t{3}]) - a)
                    .normalized();
  }
  return result;
}

/// Sums over the edges of a wall, one per triangle. In a triangle's plane the wall moves with the weight at
/// the speed 1 / (2 |q|), where q is the difference of the seeds projected to the plane.
struct WallSums {
  double length = 0, length_by_speed = 0;  ///< the latter: length times speed
};

/// Adds the edges of cell i to the sums of its row.
void add_edges(const Cells& cells, const std::vector<Vec3>& normal, const Adjacency& walls,
               std::span<const double> positions, std::size_t i, std::vector<WallSums>& sums) {
  const auto row = walls.neighbor.begin();
  const auto first = row + static_cast<std::ptrdiff_t>(walls.offset[i]);
  const auto last = row + static_cast<std::ptrdiff_t>(walls.offset[i + 1]);
  for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
    const Vec3& up = normal[cells.region[p]];
    const std::uint64_t vertex = cells.vertex_offset[p], count = cells.vertex_offset[p + 1] - vertex;
    for (std::uint64_t k = 0; k < count; ++k) {
      const Border& border = cells.border[cells.face_offset[p] + k];
      if (border.kind != Border::Kind::wall) continue;
      const auto found = std::lower_bound(first, last, border.index);
      if (found == last || *found != border.index) continue;  // too short for the adjacency to list it
      const Vec3 edge =
          point(&cells.vertices[3 * (vertex + (k + 1) % count)]) - point(&cells.vertices[3 * (vertex + k)]);
      const Vec3 q = point(&positions[3 * std::size_t{border.index}]) - point(&positions[3 * i]);
      const double in_plane = (q - q.dot(up) * up).norm(), length = edge.norm();
      WallSums& sum = sums[static_cast<std::size_t>(found - row)];
      sum.length += length;
      if (in_plane > 0) sum.length_by_speed += length / (2 * in_plane);
    }
  }
}

/// Conductances with the mean density of each wall.
std::vector<double> on_surface(Diagram& diagram, const Adjacency& walls, std::span<const double> positions) {
  const Cells& cells = diagram.cells();
  const std::vector<Vec3> normal = normals(diagram.domain().regions());
  std::vector<WallSums> sums(walls.wall.size());
  for (std::size_t i = 0; i < cells.cell_count(); ++i) add_edges(cells, normal, walls, positions, i, sums);
  std::vector<double> result(walls.wall.size());
  for (std::size_t i = 0; i < cells.cell_count(); ++i)
    for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k) {
      // The two sides differ by rounding; their mean makes the matrix symmetric.
      const std::uint32_t j = walls.neighbor[k];
      const auto row = walls.neighbor.begin();
      const auto back = std::lower_bound(row + static_cast<std::ptrdiff_t>(walls.offset[j]),
                                         row + static_cast<std::ptrdiff_t>(walls.offset[j + 1]),
                                         static_cast<std::uint32_t>(i)) -
                        row;
      const WallSums &here = sums[k], &there = sums[static_cast<std::size_t>(back)];
      const double length = here.length + there.length;
      if (length > 0) result[k] = walls.wall[k] * (here.length_by_speed + there.length_by_speed) / length;
    }
  return result;
}

}  // namespace

std::vector<double> plane_conductances(const Adjacency& walls, std::span<const double> positions,
                                       std::size_t d) {
  std::vector<double> result(walls.wall.size());
  for (std::size_t i = 0; i + 1 < walls.offset.size(); ++i)
    for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k) {
      double squared = 0;
      for (std::size_t c = 0; c < d; ++c) {
        const double q = positions[walls.neighbor[k] * d + c] - positions[i * d + c];
        squared += q * q;
      }
      result[k] = walls.wall[k] / (2 * std::sqrt(squared));
    }
  return result;
}

std::vector<double> conductances(Diagram& diagram, const Adjacency& walls,
                                 std::span<const double> positions) {
  if (diagram.domain().kind() == DomainKind::surface) return on_surface(diagram, walls, positions);
  return plane_conductances(walls, positions, static_cast<std::size_t>(diagram.domain().dimension()));
}

}  // namespace powercell
