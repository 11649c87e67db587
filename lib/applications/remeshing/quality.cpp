// mesh_quality() and farthest_from().
#include <algorithm>
#include <numbers>
#include <powercell/remeshing.hpp>
#include <tuple>

#include "lib/applications/remeshing/frame.hpp"
#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/nearest.hpp"
#include "lib/applications/remeshing/triangle.hpp"
#include "lib/base/float_environment.hpp"

namespace powercell {
namespace {

using namespace remeshing;

std::vector<std::array<std::uint32_t, 3>> rows_of(std::span<const double> vertices,
                                                  std::span<const std::uint32_t> triangles) {
  check_triangles(vertices, triangles);
  std::vector<std::array<std::uint32_t, 3>> rows;
  for (std::size_t k = 0; k < triangles.size(); k += 3)
    rows.push_back({triangles[k], triangles[k + 1], triangles[k + 2]});
  return rows;
}

std::array<Vec, 3> corners(std::span<const double> vertices, const std::array<std::uint32_t, 3>& row) {
  std::array<Vec, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    const double* at = &vertices[3 * std::size_t{row[k]}];
    corner[k] = {at[0], at[1], at[2]};
  }
  return corner;
}

/// The share of vertices whose degree differs from that of a regular mesh by at most 1.
double regular_share(const std::vector<std::array<std::uint32_t, 3>>& rows, const MeshCheck& check) {
  std::vector<int> degree(check.used.size(), 0), excess(check.used.size(), -6);
  for (const auto& row : rows)
    for (const std::uint32_t v : row) ++degree[v];
  for (const auto& [from, to] : check.boundary_edges) {
    ++degree[from];  // a boundary vertex has one more edge than triangles
    excess[from] = -4;
  }
  std::size_t used = 0, regular = 0;
  for (std::size_t v = 0; v < degree.size(); ++v) {
    if (!check.used[v]) continue;
    ++used;
    if (std::abs(degree[v] + excess[v]) <= 1) ++regular;
  }
  return static_cast<double>(regular) / static_cast<double>(used);
}

/// A frame in which both surfaces together have a size of about 1, as areas are squared.
Frame common_frame(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<double> vertices = a.vertices;
  vertices.insert(vertices.end(), b.vertices.begin(), b.vertices.end());
  std::vector<std::uint32_t> triangles = a.triangles;
  const auto first = static_cast<std::uint32_t>(a.vertices.size() / 3);
  for (const std::uint32_t v : b.triangles) triangles.push_back(first + v);
  return frame_of(vertices, triangles);
}

}  // namespace

MeshQuality mesh_quality(std::span<const double> vertices, std::span<const std::uint32_t> triangles) {
  const FloatEnvironment environment;
  const auto rows = rows_of(vertices, triangles);
  const MeshCheck check = check_mesh(rows, vertices.size() / 3);
  // Squared areas overflow for coordinates beyond 10^77 and underflow below 10^-77.
  const std::vector<double> scaled = frame_of(vertices, triangles).to(vertices);
  MeshQuality quality;
  quality.vertices = static_cast<std::size_t>(std::count(check.used.begin(), check.used.end(), true));
  quality.triangles = rows.size();
  quality.q_min = 1;
  quality.angle_min = 180;
  std::size_t below_30 = 0;
  for (const auto& row : rows) {
    const auto [a, b, c] = corners(scaled, row);
    const double q = triangle_quality(a, b, c);
    quality.q_min = std::min(quality.q_min, q);
    quality.q_mean += q / static_cast<double>(rows.size());
    double least = 180;
    for (const auto& [at, u, v] : {std::tuple(a, b, c), {b, c, a}, {c, a, b}}) {
      const double angle =
          std::atan2(norm(normal_of(at, u, v)), dot(u - at, v - at)) * 180 / std::numbers::pi;
      least = std::min(least, angle);
      quality.angle_max = std::max(quality.angle_max, angle);
      if (angle < 30) ++below_30;
    }
    quality.angle_min = std::min(quality.angle_min, least);
    quality.angle_min_mean += least / static_cast<double>(rows.size());
  }
  quality.below_30 = static_cast<double>(below_30) / (3.0 * static_cast<double>(rows.size()));
  quality.regular = regular_share(rows, check);
  quality.euler_characteristic = check.euler;
  quality.boundary_loops = check.loops;
  quality.manifold = check.not_manifold.empty();
  return quality;
}

double farthest_from(const TriangleMesh& a, const TriangleMesh& b, std::size_t samples) {
  const FloatEnvironment environment;
  const auto rows_a = rows_of(a.vertices, a.triangles), rows_b = rows_of(b.vertices, b.triangles);
  const Frame frame = common_frame(a, b);
  const std::vector<double> vertices_a = frame.to(a.vertices), vertices_b = frame.to(b.vertices);
  std::vector<std::array<Vec, 3>> target;
  for (const auto& row : rows_b) target.push_back(corners(vertices_b, row));
  const NearestPoint nearest(std::move(target));
  double area = 0, most = 0;
  for (const auto& row : rows_a) {
    const auto [p, q, r] = corners(vertices_a, row);
    area += norm(normal_of(p, q, r)) / 2;
  }
  const double share = area / static_cast<double>(std::max<std::size_t>(samples, 1));
  for (const auto& row : rows_a) {
    const auto [p, q, r] = corners(vertices_a, row);
    // A triangle divided into n^2 equal ones has (n+1)(n+2)/2 grid points.
    const double wanted = share > 0 ? norm(normal_of(p, q, r)) / 2 / share : 0;
    const int n = std::max(1, static_cast<int>(std::lround(std::sqrt(2 * wanted))));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        most = std::max(most, nearest.distance2(p + (q - p) * (static_cast<double>(i) / n) +
                                                (r - p) * (static_cast<double>(j) / n)));
  }
  return std::sqrt(most) * frame.length;
}

}  // namespace powercell
