#include "lib/domain/random_points.hpp"

#include <algorithm>
#include <cmath>

#include "lib/base/float_environment.hpp"
#include "lib/base/random.hpp"
#include "lib/domain/solid_points.hpp"

namespace powercell {
namespace {

/// A triangle or tetrahedron of a region.
struct Simplex {
  std::uint32_t region;
  std::array<std::uint32_t, 4> vertex;
  std::size_t corners;
};

Vector vertex(const RegionMesh& mesh, std::uint32_t v) {
  const double* x = &mesh.vertices[v * static_cast<std::size_t>(mesh.dimension)];
  return {x[0], x[1], mesh.dimension == 3 ? x[2] : 0.0};
}

/// The simplices of all regions: convex polygons are fans of triangles around their first vertex.
std::vector<Simplex> simplices_of(const RegionMesh& mesh) {
  std::vector<Simplex> list;
  for (std::uint32_t r = 0; r < mesh.region_count(); ++r) {
    const std::uint32_t* v = &mesh.region_vertex[mesh.region_offset[r]];
    const std::uint32_t n = mesh.region_offset[r + 1] - mesh.region_offset[r];
    if (mesh.shape == RegionShape::tetrahedron) {
      list.push_back({r, {v[0], v[1], v[2], v[3]}, 4});
    } else {
      for (std::uint32_t k = 2; k < n; ++k) list.push_back({r, {v[0], v[k - 1], v[k], 0}, 3});
    }
  }
  return list;
}

double measure_of(const RegionMesh& mesh, const Simplex& simplex) {
  const Vector a = vertex(mesh, simplex.vertex[0]);
  const Vector b = vertex(mesh, simplex.vertex[1]) - a, c = vertex(mesh, simplex.vertex[2]) - a;
  const Vector normal = cross(b, c);
  const long double twice_area = norm(normal);
  if (simplex.corners == 3) return static_cast<double>(twice_area / 2);
  return static_cast<double>(std::fabs(dot(vertex(mesh, simplex.vertex[3]) - a, normal)) / 6);
}

Vector point_in(const RegionMesh& mesh, const Simplex& simplex, std::mt19937_64& engine) {
  const std::array<long double, 4> share = uniform_barycentric(simplex.corners, engine);
  const Vector origin = vertex(mesh, simplex.vertex[0]);
  Vector point = origin;
  for (std::size_t c = 1; c < simplex.corners; ++c) {
    const Vector edge = vertex(mesh, simplex.vertex[c]) - origin;
    for (std::size_t k = 0; k < 3; ++k) point[k] += share[c] * edge[k];
  }
  return point;
}

}  // namespace

std::vector<Sample> random_points(const RegionMesh& mesh, std::size_t count, std::uint64_t random_seed) {
  if (mesh.solid_boundary) return random_points_in_solid(mesh, count, random_seed);
  std::mt19937_64 engine(random_seed);
  std::vector<Sample> samples(count);
  if (mesh.shape == RegionShape::box) {
    const Vector corner = vertex(mesh, 0);
    for (Sample& sample : samples) {
      sample = {0, corner};
      for (const std::uint32_t next : {1U, 2U, 4U})
        sample.point = sample.point + uniform(engine) * (vertex(mesh, next) - corner);
    }
    return samples;
  }
  const std::vector<Simplex> simplices = simplices_of(mesh);
  std::vector<double> cumulative;  // measure of the simplices up to and including each
  cumulative.reserve(simplices.size());
  double sum = 0;
  for (const Simplex& simplex : simplices) cumulative.push_back(sum += measure_of(mesh, simplex));
  for (Sample& sample : samples) {
    const auto at = std::upper_bound(cumulative.begin(), cumulative.end() - 1, uniform(engine) * sum);
    const Simplex& simplex = simplices[static_cast<std::size_t>(at - cumulative.begin())];
    sample = {simplex.region, point_in(mesh, simplex, engine)};
  }
  return samples;
}

std::vector<RegionPoint> random_points(const Domain& domain, std::size_t count, std::uint64_t random_seed) {
  const FloatEnvironment environment;
  std::vector<RegionPoint> points;
  points.reserve(count);
  for (const Sample& sample : random_points(domain.mesh(), count, random_seed)) {
    RegionPoint& to = points.emplace_back(RegionPoint{sample.region, {}});
    for (std::size_t k = 0; k < 3; ++k) to.point[k] = static_cast<double>(sample.point[k]);
  }
  return points;
}

}  // namespace powercell
