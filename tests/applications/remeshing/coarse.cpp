// Coarse meshes, with few points for the parts of the surface: no triangle turns over and no part
// degenerates.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/remeshing.hpp>

#include "lib/applications/remeshing/dual.hpp"
#include "lib/applications/remeshing/farthest.hpp"
#include "lib/applications/remeshing/relax.hpp"
#include "lib/applications/remeshing/star.hpp"
#include "tests/applications/remeshing/shapes.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::test {
namespace {

using namespace remeshing;

/// Adds a ball of 42 vertices to a mesh.
void add_ball(TriangleMesh& mesh, Vec centre, double radius, double flat = 1) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size() / 3);
  const Mesh ball = icosphere(1);
  for (std::size_t k = 0; k < ball.vertices.size(); k += 3)
    mesh.vertices.insert(mesh.vertices.end(),
                         {centre.x + radius * ball.vertices[k], centre.y + radius * ball.vertices[k + 1],
                          centre.z + flat * radius * ball.vertices[k + 2]});
  for (const std::uint32_t v : ball.elements) mesh.triangles.push_back(first + v);
}

Vec vertex(const TriangleMesh& mesh, std::uint32_t v) {
  return {mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]};
}

/// 27 disjoint balls.
TriangleMesh many_balls(double flat = 1) {
  TriangleMesh balls;
  for (int k = 0; k < 27; ++k)
    add_ball(balls, {static_cast<double>(k / 9), static_cast<double>(k / 3 % 3), static_cast<double>(k % 3)},
             0.3, flat);
  return balls;
}

/// The number of triangles that face inwards.
std::size_t inwards(const WorkMesh& mesh, const Surface& surface) {
  return static_cast<std::size_t>(std::count_if(
      mesh.triangles().begin(), mesh.triangles().end(),
      [&](const WorkMesh::Corners& row) { return row[0] != row[1] && faces_inwards(mesh, surface, row); }));
}

}  // namespace

TEST_CASE("collapses turn no triangle over, however many accumulate") {
  const TriangleMesh balls = many_balls(0.4);
  const Surface surface = make_surface(balls.vertices, balls.triangles, 180);
  const Sizing sizing{std::vector<double>(surface.vertex.size(), 0.2), 0.2};
  Sampling sampling(surface, sizing, {}, 1);
  fill_farthest(sampling, 800, {});
  Place left;
  WorkMesh mesh(sampling, mend(sampling, 2000, left).value());
  REQUIRE(inwards(mesh, surface) == 0);
  CHECK(reach_count(mesh, surface, sizing, 250));
  CHECK(mesh.alive() == 250);
  CHECK(inwards(mesh, surface) == 0);
}

TEST_CASE("relaxation turns no triangle of a coarse mesh over") {
  const TriangleMesh balls = many_balls();  // left with five or six vertices each
  RemeshOptions options;
  options.count = 150;
  options.rounds = 3;
  const TriangleMesh mesh = remesh(balls.vertices, balls.triangles, options).mesh;
  std::size_t wrong = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const Vec a = vertex(mesh, mesh.triangles[t]), b = vertex(mesh, mesh.triangles[t + 1]),
              c = vertex(mesh, mesh.triangles[t + 2]);
    const Vec centre{std::round(a.x), std::round(a.y), std::round(a.z)};
    if (dot(normal_of(a, b, c), a + b + c - centre * 3) <= 0) ++wrong;
  }
  CHECK(wrong == 0);
}

TEST_CASE("a small closed part keeps a volume") {
  TriangleMesh balls;
  add_ball(balls, {0, 0, 0}, 1);
  add_ball(balls, {3, 0, 0}, 0.02);
  RemeshOptions options;
  options.count = 60;
  options.rounds = 2;
  const TriangleMesh mesh = remesh(balls.vertices, balls.triangles, options).mesh;
  const MeshQuality quality = mesh_quality(mesh.vertices, mesh.triangles);
  CHECK(quality.manifold);
  CHECK(quality.euler_characteristic == 4);
  std::size_t of_small = 0;
  for (const std::uint32_t v : mesh.triangles)
    if (vertex(mesh, v).x > 2) ++of_small;
  CHECK(of_small >= 3 * 8);  // a quarter of all vertices, shared by two components
}

TEST_CASE("the fewest vertices that a topology has are reached") {
  RemeshOptions options;
  options.rounds = 2;
  const auto check = [&](const TriangleMesh& mesh, std::size_t count) {
    CAPTURE(count);
    options.count = count;
    const TriangleMesh few = remesh(mesh.vertices, mesh.triangles, options).mesh;
    const MeshQuality quality = mesh_quality(few.vertices, few.triangles);
    CHECK(quality.vertices == count);
    CHECK(quality.manifold);
    CHECK(quality.euler_characteristic == 2);
  };
  for (const std::size_t count : {4, 5, 6}) check(sphere(6), count);
  for (const std::size_t count : {8, 9}) check(cube_of_12(), count);
}

}  // namespace powercell::test
