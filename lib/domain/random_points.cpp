#include "lib/domain/random_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <powercell/error.hpp>

#include "lib/base/float_environment.hpp"
#include "lib/base/random.hpp"
#include "lib/domain/orientation.hpp"

namespace powercell {

namespace {

const double* corner(const RegionMesh& mesh, std::uint32_t triangle, std::size_t k) {
  return &mesh.vertices[3 * std::size_t{mesh.region_vertex[3 * std::size_t{triangle} + k]}];
}

std::vector<Box> boxes_of(const RegionMesh& mesh) {
  std::vector<Box> boxes(mesh.region_count());
  for (std::uint32_t t = 0; t < boxes.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) boxes[t].add(corner(mesh, t, k));
  return boxes;
}

}  // namespace

SolidPoints::SolidPoints(const RegionMesh& boundary)
    : mesh_(boundary), boxes_(boxes_of(boundary)), tree_(boxes_) {}

std::optional<bool> SolidPoints::contains(const double* point) const {
  Box line;
  line.add(point);
  line.high[0] = std::numeric_limits<double>::infinity();
  bool inside = false, unclear = false;
  tree_.for_each_meeting(line, [&](std::uint32_t t) {
    const std::array<const double*, 3> at{corner(mesh_, t, 0), corner(mesh_, t, 1), corner(mesh_, t, 2)};
    const int facing = orient2d(at[0] + 1, at[1] + 1, at[2] + 1);  // as seen along x
    bool left = false, right = false, on_edge = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const int side = orient2d(at[k] + 1, at[(k + 1) % 3] + 1, point + 1);
      left = left || side > 0;
      right = right || side < 0;
      on_edge = on_edge || side == 0;
    }
    if (left && right) return;
    const int beyond = facing * orient3d(at[0], at[1], at[2], point);
    if (on_edge || beyond == 0)
      unclear = true;
    else if (beyond < 0)
      inside = !inside;
  });
  if (unclear) return {};
  return inside;
}

std::vector<Sample> random_points_in_solid(const RegionMesh& mesh, std::size_t count,
                                           std::uint64_t random_seed) {
  constexpr double least_filling = 1e-6;
  double box = 1;
  for (std::size_t k = 0; k < 3; ++k) box *= mesh.high[k] - mesh.low[k];
  if (!(mesh.measure > least_filling * box))
    throw Error(ErrorCode::unsupported,
                "the solid fills less than a millionth of its bounding box: too little to draw points from");
  const SolidPoints solid(*mesh.solid_boundary);
  std::mt19937_64 engine(random_seed);
  std::vector<Sample> samples;
  while (samples.size() < count) {
    std::array<double, 3> x{};
    for (std::size_t k = 0; k < 3; ++k) x[k] = mesh.low[k] + (mesh.high[k] - mesh.low[k]) * uniform(engine);
    if (solid.contains(x.data()) == true) samples.push_back({0, {x[0], x[1], x[2]}});
  }
  return samples;
}

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
