#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <powercell/shapes.hpp>
#include <set>

#include "tests/domain/check_mesh.hpp"

namespace powercell {
namespace {

using std::numbers::pi;

/// Vertices - edges + triangles.
long euler(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    edges.insert(std::minmax(mesh.triangles[k], mesh.triangles[k % 3 == 2 ? k - 2 : k + 1]));
  }
  return long(mesh.vertices.size() / 3) - long(edges.size()) + long(mesh.triangles.size() / 3);
}

/// Volume enclosed by a mesh that is oriented outwards.
double enclosed(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t k = 0; k < mesh.triangles.size(); k += 3) {
    const double *a = &mesh.vertices[3 * mesh.triangles[k]], *b = &mesh.vertices[3 * mesh.triangles[k + 1]],
                 *c = &mesh.vertices[3 * mesh.triangles[k + 2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

/// Radius of a ball inside a triangulated unit sphere whose coarse edges of angle `edge` are cut in n:
/// no triangle has a circumscribed circle larger than an edge of it is long.
double inner_radius(double edge, int n) {
  return std::sqrt(std::max(0.0, 1 - std::pow(edge / n, 2)));
}

TEST_CASE("disk") {
  for (int n : {3, 4, 24, 25, 1000}) {
    const std::vector<PolygonPart> parts{{disk(n), {}}};
    const Domain domain = Domain::polygon(parts);
    test::check_mesh(domain);
    CHECK(domain.measure() == doctest::Approx(n / 2.0 * std::sin(2 * pi / n)).epsilon(1e-14));
    CHECK(domain.mesh().boundary_count == n);
  }
  CHECK_THROWS_AS(disk(2), Error);
}

TEST_CASE("sphere") {
  for (int n : {1, 2, 3, 10, 40}) {
    const TriangleMesh mesh = sphere(n);
    CHECK(mesh.vertices.size() == 3 * (10 * std::size_t(n) * n + 2));
    CHECK(mesh.triangles.size() == 3 * 20 * std::size_t(n) * n);
    CHECK(euler(mesh) == 2);
    for (std::size_t k = 0; k < mesh.vertices.size(); k += 3) {
      REQUIRE(std::hypot(mesh.vertices[k], mesh.vertices[k + 1], mesh.vertices[k + 2]) ==
              doctest::Approx(1).epsilon(1e-15));
    }
    const Domain domain = Domain::surface(mesh.vertices, mesh.triangles);
    test::check_mesh(domain);
    CHECK(domain.mesh().boundary_count == 0);
    // It lies in the unit ball and holds the one that its triangles' planes leave free.
    const double inner = inner_radius(std::atan(2), n);
    CHECK(enclosed(mesh) < 4 * pi / 3);
    CHECK(enclosed(mesh) > 4 * pi / 3 * std::pow(inner, 3));
    CHECK(domain.measure() < 4 * pi);
    CHECK(domain.measure() > 4 * pi * std::pow(inner, 2));
  }
  // The icosahedron itself.
  const TriangleMesh solid = sphere(1);
  const double edge = 4 / std::sqrt(10 + 2 * std::sqrt(5.0));
  CHECK(Domain::surface(solid.vertices, solid.triangles).measure() ==
        doctest::Approx(5 * std::sqrt(3.0) * edge * edge).epsilon(1e-14));
  CHECK_THROWS_AS(sphere(0), Error);
}

TEST_CASE("torus") {
  for (int n : {3, 4, 7, 40}) {
    const TriangleMesh mesh = torus(n);
    CHECK(euler(mesh) == 0);
    const Domain domain = Domain::surface(mesh.vertices, mesh.triangles);
    test::check_mesh(domain);
    CHECK(domain.mesh().boundary_count == 0);
    CHECK(enclosed(mesh) > 0);
    CHECK(domain.measure() < 4 * pi * pi * 0.4);
    CHECK(domain.measure() > 4 * pi * pi * 0.4 * (1 - 5.0 / (n * n)));
  }
  CHECK_THROWS_AS(torus(2), Error);
}

/// 3 x inscribed / circumscribed radius of the worst tetrahedron: 1 for a regular one.
double worst_shape(const TetrahedralMesh& mesh) {
  using Point = std::array<double, 3>;
  auto cross = [](const Point& a, const Point& b) {
    return Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  auto norm = [](const Point& a) { return std::hypot(a[0], a[1], a[2]); };
  double worst = 1;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    const double* o = &mesh.vertices[3 * mesh.tetrahedra[t]];
    Point e[3];
    for (int c = 0; c < 3; ++c) {
      const double* v = &mesh.vertices[3 * mesh.tetrahedra[t + 1 + c]];
      e[c] = {v[0] - o[0], v[1] - o[1], v[2] - o[2]};
    }
    const Point n0 = cross(e[1], e[2]), n1 = cross(e[2], e[0]), n2 = cross(e[0], e[1]);
    const double six = e[0][0] * n0[0] + e[0][1] * n0[1] + e[0][2] * n0[2];
    Point sum, far{};
    for (int k = 0; k < 3; ++k) {
      sum[k] = n0[k] + n1[k] + n2[k];
      const Point* n[3] = {&n0, &n1, &n2};
      for (int c = 0; c < 3; ++c) {
        far[k] += (*n[c])[k] * (e[c][0] * e[c][0] + e[c][1] * e[c][1] + e[c][2] * e[c][2]);
      }
    }
    const double inscribed = six / (norm(n0) + norm(n1) + norm(n2) + norm(sum));
    worst = std::min(worst, 3 * inscribed / (norm(far) / (2 * six)));
  }
  return worst;
}

TEST_CASE("ball") {
  for (int n : {1, 2, 3, 8, 20}) {
    const TetrahedralMesh mesh = ball(n);
    CHECK(mesh.tetrahedra.size() == 4 * 8 * std::size_t(n) * n * n);
    const Domain domain = Domain::volume(mesh.vertices, mesh.tetrahedra);
    test::check_mesh(domain);
    CHECK(domain.region_count() == 8 * std::size_t(n) * n * n);
    // Given positively oriented, so kept as given.
    CHECK(domain.mesh().region_vertex == mesh.tetrahedra);
    CHECK(domain.mesh().boundary_count == 8 * n * n);
    CHECK(domain.measure() < 4 * pi / 3);
    CHECK(domain.measure() > 4 * pi / 3 * std::pow(inner_radius(pi / 2, n), 3));
    CHECK(worst_shape(mesh) > 0.5);
  }
  const TetrahedralMesh octahedron = ball(1);
  CHECK(Domain::volume(octahedron.vertices, octahedron.tetrahedra).measure() ==
        doctest::Approx(4.0 / 3).epsilon(1e-15));
  CHECK_THROWS_AS(ball(0), Error);
}

}  // namespace
}  // namespace powercell
