#include "tests/domain/check_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "lib/base/vectors.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell::test {
namespace {

using Point = Vector3<long double>;

Point vertex(const RegionMesh& mesh, std::uint32_t v) {
  Point p{};
  for (int k = 0; k < mesh.dimension; ++k) p[k] = mesh.vertices[std::size_t(mesh.dimension) * v + k];
  return p;
}

std::vector<Point> region(const RegionMesh& mesh, std::size_t r) {
  std::vector<Point> points;
  for (auto k = mesh.region_offset[r]; k < mesh.region_offset[r + 1]; ++k) {
    points.push_back(vertex(mesh, mesh.region_vertex[k]));
  }
  return points;
}

/// The measure of a region, with a sign except on surfaces, so that a wrong orientation shows in the sum.
long double measure(const RegionMesh& mesh, const std::vector<Point>& p) {
  if (mesh.shape == RegionShape::box) return dot(p[1] - p[0], cross(p[2] - p[0], p[4] - p[0]));
  if (mesh.shape == RegionShape::tetrahedron) return dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0])) / 6;
  Point sum{};
  for (std::size_t k = 2; k < p.size(); ++k) sum = sum + cross(p[k - 1] - p[0], p[k] - p[0]);
  return mesh.dimension == 2 ? sum[2] / 2 : norm(sum) / 2;
}

/// Positions of the vertices of a facet, sorted, so that they are the same from both sides.
std::vector<Point> facet_points(const RegionMesh& mesh, std::size_t r, std::uint32_t facet) {
  std::vector<Point> points = region(mesh, r);
  std::vector<Point> of_facet;
  if (mesh.shape == RegionShape::tetrahedron) {
    of_facet = points;
    of_facet.erase(of_facet.begin() + facet);
  } else {
    of_facet = {points[facet], points[(facet + 1) % points.size()]};
  }
  std::ranges::sort(of_facet);
  return of_facet;
}

std::size_t broken_borders(const RegionMesh& mesh) {
  std::size_t broken = 0;
  std::set<std::uint32_t> numbers;
  for (std::uint32_t r = 0; r < mesh.region_count(); ++r) {
    const std::uint32_t begin = mesh.facet_offset[r], end = mesh.facet_offset[r + 1];
    for (std::uint32_t slot = begin; slot < end; ++slot) {
      const Border border = mesh.facet[slot];
      if (border.kind == Border::Kind::boundary) {
        broken += !numbers.insert(border.index).second || border.index >= mesh.boundary_count;
        continue;
      }
      // The region behind must have the same facet.
      if (border.kind != Border::Kind::interior || border.index >= mesh.region_count() || border.index == r) {
        ++broken;
        continue;
      }
      const auto mine = facet_points(mesh, r, slot - begin);
      std::size_t matches = 0;
      const std::uint32_t count = mesh.facet_offset[border.index + 1] - mesh.facet_offset[border.index];
      for (std::uint32_t other = 0; other < count; ++other) {
        matches += mesh.facet[mesh.facet_offset[border.index] + other].kind == Border::Kind::interior &&
                   facet_points(mesh, border.index, other) == mine;
      }
      broken += matches != 1;
    }
  }
  return broken + (numbers.size() != mesh.boundary_count);
}

std::size_t broken_regions(const RegionMesh& mesh) {
  std::size_t broken = 0;
  for (std::size_t r = 0; r < mesh.region_count(); ++r) {
    broken += !(measure(mesh, region(mesh, r)) > 0);
    if (mesh.kind != DomainKind::polygon) continue;
    const std::uint32_t* v = &mesh.region_vertex[mesh.region_offset[r]];
    const std::size_t n = mesh.region_offset[r + 1] - mesh.region_offset[r];
    broken += n < 3 || n > 24;
    for (std::size_t k = 0; k < n; ++k) {
      broken += orient2d(&mesh.vertices[2 * v[k]], &mesh.vertices[2 * v[(k + 1) % n]],
                         &mesh.vertices[2 * v[(k + 2) % n]]) < 0;
    }
  }
  return broken;
}

}  // namespace

void check_mesh(const Domain& domain) {
  const RegionMesh& mesh = domain.mesh();
  REQUIRE(mesh.region_count() > 0);
  REQUIRE(mesh.region_offset.size() == mesh.region_count() + 1);
  REQUIRE(mesh.facet_offset.size() == mesh.region_count() + 1);
  REQUIRE(mesh.region_offset.front() == 0);
  REQUIRE(mesh.region_offset.back() == mesh.region_vertex.size());
  REQUIRE(mesh.facet_offset.back() == mesh.facet.size());
  REQUIRE(std::ranges::max(mesh.region_vertex) < mesh.vertices.size() / mesh.dimension);
  CHECK(broken_borders(mesh) == 0);
  CHECK(broken_regions(mesh) == 0);

  long double sum = 0;
  Point low = vertex(mesh, mesh.region_vertex[0]), high = low;
  for (std::size_t r = 0; r < mesh.region_count(); ++r) {
    const auto points = region(mesh, r);
    sum += measure(mesh, points);
    for (const Point& p : points) {
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    }
  }
  CHECK(std::fabs(static_cast<double>(sum / mesh.measure - 1)) <= 1e-15);
  for (int k = 0; k < 3; ++k) {
    CHECK(domain.low()[k] == static_cast<double>(low[k]));
    CHECK(domain.high()[k] == static_cast<double>(high[k]));
  }
}

}  // namespace powercell::test
