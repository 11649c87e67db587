#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <powercell/shapes.hpp>
#include <set>

#include "lib/base/vectors.hpp"
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

/// Volume enclosed by a mesh whose triangles are counter-clockwise seen from outside.
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

/// Radius of a ball inside a triangulated unit sphere whose coarse edges, of angle `edge`, are divided by n:
/// the radius of a triangle's circumscribed circle is at most the length of an edge.
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
    // It lies in the unit ball and contains the ball that the planes of its triangles do not enter.
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
  using Point = Vector3<double>;
  double worst = 1;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); t += 4) {
    const auto edge = [&](std::size_t c) {
      return difference<double>(&mesh.vertices[3 * mesh.tetrahedra[t + c]],
                                &mesh.vertices[3 * mesh.tetrahedra[t]]);
    };
    const Point a = edge(1), b = edge(2), c = edge(3);
    const Point bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const double six_volumes = dot(a, bc);
    const double inscribed = six_volumes / (norm(bc) + norm(ca) + norm(ab) + norm(bc + ca + ab));
    const double circumscribed = norm(dot(a, a) * bc + dot(b, b) * ca + dot(c, c) * ab) / (2 * six_volumes);
    worst = std::min(worst, 3 * inscribed / circumscribed);
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
    // All tetrahedra are positive, so the domain keeps them as they are.
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
