// repair(): each fault of a mesh alone, what is done about it, and the right topology and measure afterwards.
#include <doctest/doctest.h>

#include <cmath>
#include <powercell/error.hpp>
#include <powercell/remeshing.hpp>
#include <powercell/repair.hpp>

#include "lib/applications/remeshing/vec.hpp"
#include "tests/applications/remeshing/shapes.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::test {
namespace {

using remeshing::Vec;

RepairedMesh repaired(const TriangleMesh& mesh, double weld = -1) {
  return repair(mesh.vertices, mesh.triangles, {weld});
}

Vec at(const TriangleMesh& mesh, std::uint32_t v) {
  return {mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]};
}

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3)
    sum += dot(at(mesh, mesh.triangles[t]),
               cross(at(mesh, mesh.triangles[t + 1]), at(mesh, mesh.triangles[t + 2]))) /
           6;
  return std::fabs(sum);
}

/// Checks a repaired mesh: a closed oriented manifold with a number of components and a volume.
void check_closed(const RepairedMesh& result, std::size_t components, double wanted_volume) {
  CHECK(result.report.components == components);
  CHECK(result.report.boundary_edges == 0);
  const MeshQuality quality = mesh_quality(result.mesh.vertices, result.mesh.triangles);
  CHECK(quality.manifold);
  CHECK(quality.euler_characteristic == 2 * static_cast<int>(components));
  CHECK(quality.boundary_loops == 0);
  CHECK(volume(result.mesh) == doctest::Approx(wanted_volume).epsilon(1e-5));
}

/// Appends a mesh with vertices of its own, moved.
void append(TriangleMesh& to, const TriangleMesh& mesh, Vec by) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size() / 3);
  for (std::uint32_t v = 0; 3 * v < mesh.vertices.size(); ++v) {
    const Vec x = at(mesh, v) + by;
    to.vertices.insert(to.vertices.end(), {x.x, x.y, x.z});
  }
  for (const std::uint32_t v : mesh.triangles) to.triangles.push_back(first + v);
}

/// Two unit cubes, the second moved.
TriangleMesh two_cubes(Vec by) {
  TriangleMesh cubes = cube_of_12();
  append(cubes, cube_of_12(), by);
  return cubes;
}

/// Gives vertices at the same position the index of the first of them.
void merge(TriangleMesh& mesh) {
  for (std::uint32_t& v : mesh.triangles)
    for (std::uint32_t u = 0; u < v; ++u)
      if (at(mesh, u) == at(mesh, v)) v = u;
}

/// Each triangle with three vertices of its own, moved by up to `noise` along each axis.
TriangleMesh soup(const TriangleMesh& mesh, double noise, Random& random) {
  TriangleMesh result;
  for (const std::uint32_t v : mesh.triangles) {
    result.triangles.push_back(static_cast<std::uint32_t>(result.triangles.size()));
    for (std::size_t k = 0; k < 3; ++k)
      result.vertices.push_back(mesh.vertices[3 * v + k] + noise * (2 * random.uniform() - 1));
  }
  return result;
}

}  // namespace

TEST_CASE("a mesh without faults stays as it is") {
  for (const TriangleMesh& mesh : {cube_of_12(), small_torus(), wavy_sheet()}) {
    const RepairedMesh result = repaired(mesh);
    CHECK_FALSE(result.report.changed());
    CHECK(result.report.acts().empty());
    CHECK(result.report.left().empty());
    CHECK(result.mesh.vertices == mesh.vertices);
    CHECK(result.mesh.triangles == mesh.triangles);
  }
}

TEST_CASE("triangles with vertices of their own are joined by position, without an act") {
  Random random(1);
  const RepairedMesh result = repaired(soup(cube_of_12(), 0, random));
  CHECK_FALSE(result.report.changed());
  check_closed(result, 1, 1);
  CHECK(mesh_quality(result.mesh.vertices, result.mesh.triangles).vertices == 8);
}

TEST_CASE("edges a little apart are welded, those farther apart only if asked for") {
  Random random(test_seed());
  INFO(replay_hint());
  const RepairedMesh near = repaired(soup(cube_of_12(), 2e-7, random));
  CHECK(near.report.welded.count == 18);
  CHECK(near.report.moved > 0);
  CHECK(near.report.moved < 2e-6);
  check_closed(near, 1, 1);
  CHECK(near.report.acts().size() == 1);

  const TriangleMesh wide = soup(cube_of_12(), 1e-4, random);
  const RepairedMesh open = repaired(wide);
  CHECK(open.report.welded.count == 0);
  CHECK(open.report.components == 12);
  CHECK(open.report.boundary_edges == 36);
  const RepairedMesh closed = repaired(wide, 1e-3);
  CHECK(closed.report.welded.count == 18);
  CHECK(closed.report.components == 1);
  CHECK(closed.report.boundary_edges == 0);
  CHECK_THROWS_AS(repaired(wide, NAN), Error);
}

TEST_CASE("the tolerance is that of single precision where coordinates have it") {
  // A cube of size 100 at 10^4, with coordinates a last place of single precision, some 10^-3, apart.
  Random random(1);
  TriangleMesh mesh = soup(cube_of_12(), 0, random);
  for (double& x : mesh.vertices) {
    const double step = random.uniform() < 0.25 ? 0x1p-10 : 0;  // the last place of single precision there
    x = static_cast<float>(x * 100 + 10000 + step);
  }
  const RepairedMesh result = repaired(mesh);
  CHECK(result.report.welded.count > 0);
  CHECK(result.report.components == 1);
  CHECK(result.report.boundary_edges == 0);
}

TEST_CASE("solids that touch stay apart, whether they share vertices or not") {
  struct Touch {
    Vec by;
    std::size_t edges, vertices;
  };
  // Along an edge, and in a vertex.
  for (const auto& [by, edges, vertices] : {Touch{{1, 1, 0}, 1, 2}, Touch{{1, 1, 1}, 0, 1}}) {
    TriangleMesh cubes = two_cubes(by);
    const RepairedMesh own = repaired(cubes);
    CHECK_FALSE(own.report.changed());
    check_closed(own, 2, 2);
    merge(cubes);
    const RepairedMesh shared = repaired(cubes);
    CHECK(shared.report.split_edges.count == edges);
    CHECK(shared.report.split_vertices.count == vertices);
    check_closed(shared, 2, 2);
    // As a soup, only positions say what belongs together.
    Random random(1);
    check_closed(repaired(soup(cubes, 0, random)), 2, 2);
  }
}

TEST_CASE("a face between two cubes that both have stays twice, and a page stays at its spine") {
  check_closed(repaired(two_cubes({1, 0, 0})), 2, 2);
  const Mesh pages = book(3);
  const RepairedMesh result = repaired({pages.vertices, pages.elements});
  CHECK(result.report.split_edges.count > 0);
  CHECK(mesh_quality(result.mesh.vertices, result.mesh.triangles).manifold);
}

TEST_CASE("triangles with repeated corners and repeated triangles are removed") {
  TriangleMesh mesh = cube_of_12();
  mesh.vertices.insert(mesh.vertices.end(), {1, 1, 1});                               // again
  mesh.triangles.insert(mesh.triangles.end(), {0, 1, 1, 7, 8, 3, 3, 2, 0, 4, 5, 7});  // two of each
  const RepairedMesh result = repaired(mesh);
  CHECK(result.report.degenerate.count == 2);
  CHECK(result.report.repeated.count == 2);
  check_closed(result, 1, 1);
  // Every face twice, the second time for the other side.
  TriangleMesh twice = cube_of_12();
  for (std::size_t t = 0; t < 36; t += 3)
    twice.triangles.insert(twice.triangles.end(),
                           {twice.triangles[t + 1], twice.triangles[t], twice.triangles[t + 2]});
  const RepairedMesh once = repaired(twice);
  CHECK(once.report.repeated.count == 12);
  check_closed(once, 1, 1);
  CHECK_THROWS_AS(repaired({{0, 0, 0, 1, 0, 0}, {0, 1, 1}}), Error);
}

TEST_CASE("triangles are turned as most of their part") {
  for (const std::vector<std::size_t>& wrong : {std::vector<std::size_t>{4}, {0}, {0, 1, 2, 3, 7}}) {
    TriangleMesh mesh = cube_of_12();
    for (const std::size_t t : wrong) std::swap(mesh.triangles[3 * t], mesh.triangles[3 * t + 1]);
    const RepairedMesh result = repaired(mesh);
    CHECK(result.report.turned.count == wrong.size());
    check_closed(result, 1, 1);
  }
}

TEST_CASE("flat triangles are removed by a flip or a collapse") {
  // A corner on the opposite edge: the cube's edge from 0 to 1 has a vertex in the middle that only one of
  // its two faces has; a triangle without area is between them.
  TriangleMesh cap = cube_of_12();
  cap.vertices.insert(cap.vertices.end(), {0.5, 0, 0});
  for (std::size_t t = 0; t < cap.triangles.size(); t += 3) {
    std::uint32_t* row = &cap.triangles[t];
    if (row[0] != 0 || row[1] != 1 || row[2] != 5) continue;
    row[1] = 8;
    cap.triangles.insert(cap.triangles.end(), {8, 1, 5, 0, 1, 8});
    break;
  }
  REQUIRE(cap.triangles.size() == 42);
  const RepairedMesh flipped = repaired(cap);
  CHECK(flipped.report.flat.count == 1);
  CHECK(flipped.report.left_flat.count == 0);
  check_closed(flipped, 1, 1);
  // Two corners 10^-9 apart.
  TriangleMesh needle = cap;
  needle.vertices[24] = 1e-9;
  const RepairedMesh collapsed = repaired(needle);
  CHECK(collapsed.report.flat.count > 0);
  CHECK(collapsed.report.left_flat.count == 0);
  check_closed(collapsed, 1, 1);
}

TEST_CASE("parts that cross are left and reported with their place") {
  const RepairedMesh result = repaired(two_cubes({0.5, 0.4, 0.3}));
  CHECK_FALSE(result.report.changed());
  CHECK(result.report.intersections.count > 0);
  for (const double x : result.report.intersections.first) CHECK((x > 0 && x < 1.5));
  REQUIRE(result.report.left().size() == 1);
  CHECK(result.report.left().front().find("cross each other") != std::string::npos);
  CHECK(repaired(two_cubes({1.5, 0, 0})).report.intersections.count == 0);
}

TEST_CASE("meshes with all of these faults are remeshed, with the report of the repair") {
  Random random(1);
  TriangleMesh mesh = soup(two_cubes({1, 1, 0}), 1e-7, random);
  mesh.triangles.insert(mesh.triangles.end(), {0, 0, 1});
  std::swap(mesh.triangles[3], mesh.triangles[4]);
  RemeshOptions options;
  options.count = 300;
  options.rounds = 2;
  const RemeshResult result = remesh(mesh.vertices, mesh.triangles, options);
  CHECK(result.repair.degenerate.count == 1);
  CHECK(result.repair.turned.count == 1);
  CHECK(result.repair.welded.count == 36);
  CHECK(result.repair.components == 2);
  const MeshQuality quality = mesh_quality(result.mesh.vertices, result.mesh.triangles);
  CHECK(quality.manifold);
  CHECK(quality.euler_characteristic == 4);
  CHECK(quality.boundary_loops == 0);
  CHECK(volume(result.mesh) == doctest::Approx(2).epsilon(0.001));
}

}  // namespace powercell::test
