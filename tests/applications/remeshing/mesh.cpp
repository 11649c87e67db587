// Parts of remeshing: manifold check, parts of cells, editing and fitting of the new mesh, projection,
// quality and distance measures.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <powercell/error.hpp>
#include <powercell/remeshing.hpp>

#include "lib/applications/remeshing/cell_parts.hpp"
#include "lib/applications/remeshing/farthest.hpp"
#include "lib/applications/remeshing/mesh_check.hpp"
#include "lib/applications/remeshing/nearest.hpp"
#include "lib/applications/remeshing/relax.hpp"
#include "lib/applications/remeshing/triangle.hpp"
#include "tests/applications/remeshing/surface_from.hpp"
#include "tests/support/generators.hpp"

namespace powercell::test {
namespace {

using namespace remeshing;
using Rows = std::vector<std::array<std::uint32_t, 3>>;

/// The dual of 300 farthest points.
WorkMesh mesh_of_300(const Surface& surface, const Sizing& sizing) {
  Sampling sampling(surface, sizing, kept_curves(surface, 45), 3);
  sampling.place_on_curves(300);
  fill_farthest(sampling, 300, {});
  Place left;
  return WorkMesh(sampling, mend(sampling, 600, left).value());
}

}  // namespace

TEST_CASE("check_mesh distinguishes manifolds from other lists of triangles") {
  const Rows ball = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const MeshCheck closed = check_mesh(ball, 4);
  CHECK(closed.not_manifold.empty());
  CHECK(closed.euler == 2);
  CHECK(closed.loops == 0);
  const MeshCheck open = check_mesh(Rows{ball.begin(), ball.begin() + 3}, 4);
  CHECK(open.not_manifold.empty());
  CHECK(open.euler == 1);
  CHECK(open.loops == 1);
  CHECK(open.boundary_edges.size() == 3);
  // A triangle turned over, a repeated triangle, a triangle and its reverse, a third triangle at an edge, two
  // fans at a vertex.
  CHECK_FALSE(check_mesh(Rows{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 4).not_manifold.empty());
  CHECK_FALSE(check_mesh(Rows{{0, 1, 2}, {0, 1, 2}}, 3).not_manifold.empty());
  CHECK_FALSE(check_mesh(Rows{{0, 1, 2}, {0, 2, 1}}, 3).not_manifold.empty());
  CHECK_FALSE(check_mesh(Rows{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5).not_manifold.empty());
  CHECK_FALSE(check_mesh(Rows{{0, 1, 2}, {0, 3, 4}}, 5).not_manifold.empty());
}

TEST_CASE("the Euler characteristics of the components of cells") {
  // The cell of a single seed is the whole torus; two seeds on opposite sides have annuli.
  const Surface ring = surface_from(small_torus());
  LocalDiagram cells(ring);
  cells.insert({1.01, 0.02, 0.03}, 0, 1);
  CHECK(cell_parts(cells).euler == std::vector<int>{0});
  cells.insert({-1.02, 0.01, -0.02}, 0, 1);
  CHECK(cell_parts(cells).euler == std::vector<int>{0, 0});
  // A seed just above a thin plate, surrounded by others, has a disc on each side.
  const Surface sheets = surface_from(plate(0.01));
  LocalDiagram on_plate(sheets);
  for (const Vec at :
       {Vec{0.5, 0.5, 0.02}, {0.1, 0.5, 0.005}, {0.9, 0.5, 0.005}, {0.5, 0.1, 0.005}, {0.5, 0.9, 0.005}})
    on_plate.insert(at, 0, 1);
  const CellParts parts = cell_parts(on_plate);
  CHECK(parts.seed.size() == 6);
  CHECK(std::count(parts.seed.begin(), parts.seed.end(), 0u) == 2);
  CHECK(std::all_of(parts.euler.begin(), parts.euler.end(), [](int euler) { return euler == 1; }));
}

TEST_CASE("flips, collapses and splits keep a manifold of the same topology") {
  Random random(test_seed());
  INFO(replay_hint());
  for (const NamedMesh& shape : smooth_meshes()) {
    CAPTURE(shape.name);
    const Surface surface = surface_from(shape.mesh);
    const Sizing sizing = scaled_sizing(surface, std::vector<double>(surface.vertex.size(), 1.0), 0.3, 300);
    WorkMesh mesh = mesh_of_300(surface, sizing);
    const std::size_t start = mesh.alive();
    int flips = 0, collapses = 0, splits = 0;
    for (int step = 0; step < 3000; ++step) {
      const auto a = static_cast<std::uint32_t>(random.index(mesh.vertex_count()));
      if (!mesh.is_alive(a)) continue;
      const auto around = mesh.neighbors(a);
      const std::uint32_t b = around[random.index(around.size())];
      const auto edge = mesh.edge(a, b);
      if (!edge) continue;
      const std::size_t what = random.index(5);
      if (what < 3 && mesh.can_flip(*edge)) {
        mesh.flip(*edge);
        ++flips;
      } else if (what == 3 && mesh.alive() > 100 && mesh.can_collapse(a, b, 5)) {
        mesh.collapse(a, b);
        ++collapses;
      } else if (what == 4 && !mesh.kept(a, b)) {
        mesh.split(*edge, mesh.vertex(a).place, 0.1);
        ++splits;
      }
    }
    CHECK(flips > 100);
    CHECK(collapses > 50);
    CHECK(splits > 50);
    CHECK(mesh.alive() == start + static_cast<std::size_t>(splits - collapses));
    Rows rows;
    for (const auto& row : mesh.triangles())
      if (row[0] != row[1]) rows.push_back(row);
    const MeshCheck check = check_mesh(rows, mesh.vertex_count());
    CHECK(check.not_manifold.empty());
    CHECK(check.euler == shape.euler);
    CHECK(check.loops == shape.loops);
  }
}

TEST_CASE("projection and distance queries agree with a search over all triangles") {
  const Surface ball = surface_from(sphere(12));
  Random random(test_seed());
  for (int k = 0; k < 200; ++k) {
    const auto t = static_cast<std::uint32_t>(random.index(ball.size()));
    const Vec from = (ball.corner(t, 0) + ball.corner(t, 1) + ball.corner(t, 2)) * (1.0 / 3);
    const Vec x = from + Vec{random.normal(), random.normal(), random.normal()} * 0.05;
    const Place place = project(ball, {t, from}, x);
    std::vector<std::array<Vec, 3>> triangles;
    for (std::uint32_t s = 0; s < ball.size(); ++s)
      triangles.push_back({ball.corner(s, 0), ball.corner(s, 1), ball.corner(s, 2)});
    double least = 1e300;
    for (const auto& [a, b, c] : triangles)
      least = std::min(least, norm2(nearest_in_triangle(x, a, b, c) - x));
    CHECK(norm2(place.at - x) == doctest::Approx(least));
    CHECK(NearestPoint(triangles).distance2(x) == least);
  }
}

TEST_CASE("fitting brings the farthest triangles closer without worse shapes") {
  std::size_t nearer = 0;
  for (const NamedMesh& shape : smooth_meshes()) {
    CAPTURE(shape.name);
    const Surface surface = surface_from(shape.mesh);
    const Sizing sizing = scaled_sizing(surface, std::vector<double>(surface.vertex.size(), 1.0), 0.3, 300);
    WorkMesh mesh = mesh_of_300(surface, sizing);
    relax(mesh, surface, sizing, 10);
    std::vector<std::array<Vec, 3>> input;
    for (std::uint32_t t = 0; t < surface.size(); ++t)
      input.push_back({surface.corner(t, 0), surface.corner(t, 1), surface.corner(t, 2)});
    const NearestPoint nearest(input);
    const auto figures = [&] {
      double farthest = 0, shape_cost = 0;
      for (const auto& row : mesh.triangles()) {
        if (row[0] == row[1]) continue;
        const Vec a = mesh.at(row[0]), b = mesh.at(row[1]), c = mesh.at(row[2]);
        for (const Vec x : {(a + b + c) * (1.0 / 3), (a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5})
          farthest = std::max(farthest, nearest.distance2(x));
        shape_cost = std::max(shape_cost, misshape(a, b, c, 0.74));
      }
      return std::pair(farthest, shape_cost);
    };
    const auto [far_before, shape_before] = figures();
    const std::vector<WorkMesh::Corners> rows_before = mesh.triangles();
    fit(mesh, surface, sizing, 3);
    const auto [far_after, shape_after] = figures();
    CHECK(far_after <= far_before);
    CHECK(shape_after <= std::max(1.0, shape_before));
    nearer += far_after < 0.9 * far_before ? 1 : 0;
    Rows rows;
    for (const auto& row : mesh.triangles())
      if (row[0] != row[1]) rows.push_back(row);
    const MeshCheck check = check_mesh(rows, mesh.vertex_count());
    CHECK(check.not_manifold.empty());
    CHECK(check.euler == surface.euler_characteristic());
    CHECK(rows.size() ==
          static_cast<std::size_t>(std::count_if(rows_before.begin(), rows_before.end(),
                                                 [](const auto& row) { return row[0] != row[1]; })));
  }
  CHECK(nearer >= 3);
}

TEST_CASE("measures of single triangles") {
  const Vec a{0, 0, 0}, b{1, 0, 0}, c{0.5, std::sqrt(0.75), 0}, d{0, 1, 0};
  CHECK(triangle_quality(a, b, c) == doctest::Approx(1));
  CHECK(largest_cosine(a, b, c) == doctest::Approx(0.5));
  // Right and isosceles: area 1/2, half perimeter 1 + sqrt(1/2), longest sqrt(2).
  CHECK(triangle_quality(a, b, d) == doctest::Approx(std::sqrt(3.0) / (std::sqrt(2.0) + 1)));
  CHECK(std::acos(largest_cosine(a, b, d)) == doctest::Approx(std::numbers::pi / 4));
  CHECK(misshape(a, b, d, 0.7) < 1);
  const Vec needle{0.5, 2, 0}, blunt{0.5, 0.45, 0};  // one angle of 28 degrees; two of 42 and one of 96
  CHECK(misshape(a, b, needle, 0.7) ==
        doctest::Approx(largest_cosine(a, b, needle) / std::cos(40 * std::numbers::pi / 180)));
  CHECK(misshape(a, b, needle, 0.7) > 1);
  CHECK(largest_cosine(a, b, blunt) < std::cos(40 * std::numbers::pi / 180));
  CHECK(misshape(a, b, blunt, 0.7) > 1);
}

TEST_CASE("quality measures of known meshes") {
  const TriangleMesh cube = cube_of_12();
  const MeshQuality q = mesh_quality(cube.vertices, cube.triangles);
  CHECK(q.vertices == 8);
  CHECK(q.triangles == 12);
  CHECK(q.manifold);
  CHECK(q.euler_characteristic == 2);
  CHECK(q.boundary_loops == 0);
  CHECK(q.angle_min == doctest::Approx(45));
  CHECK(q.angle_max == doctest::Approx(90));
  CHECK(q.below_30 == 0);
  CHECK(q.q_mean == doctest::Approx(std::sqrt(3.0) / (std::sqrt(2.0) + 1)));
  const std::vector<double> needle = {0, 0, 0, 1, 0, 0, 0.5, 0.05, 0};
  CHECK(mesh_quality(needle, std::vector<std::uint32_t>{0, 1, 2}).below_30 == doctest::Approx(2.0 / 3));
  CHECK_THROWS_AS(mesh_quality(needle, std::vector<std::uint32_t>{0, 1, 3}), Error);
  const TriangleMesh torus = powercell::torus(12);
  CHECK(mesh_quality(torus.vertices, torus.triangles).euler_characteristic == 0);
  CHECK(mesh_quality(torus.vertices, torus.triangles).regular == 1);
}

TEST_CASE("quality measures and relative distances do not depend on the scale") {
  const TriangleMesh ball = sphere(4);
  const MeshQuality expected = mesh_quality(ball.vertices, ball.triangles);
  for (const double scale : {1e-99, 1e-80, 1e80, 1e99}) {
    CAPTURE(scale);
    TriangleMesh scaled = ball, half = ball;
    for (double& x : scaled.vertices) x *= scale;
    for (double& x : half.vertices) x *= scale / 2;
    const MeshQuality q = mesh_quality(scaled.vertices, scaled.triangles);
    CHECK(q.q_min == doctest::Approx(expected.q_min));
    CHECK(q.q_mean == doctest::Approx(expected.q_mean));
    CHECK(q.angle_min == doctest::Approx(expected.angle_min));
    CHECK(q.angle_max == doctest::Approx(expected.angle_max));
    CHECK(farthest_from(scaled, half, 20000) / scale == doctest::Approx(0.5).epsilon(0.02));
  }
}

TEST_CASE("distances between surfaces") {
  TriangleMesh low = cube_of_12(), high = low;
  for (std::size_t k = 2; k < high.vertices.size(); k += 3) high.vertices[k] += 0.25;
  CHECK(farthest_from(low, high) == doctest::Approx(0.25));
  CHECK(farthest_from(low, low) < 1e-15);
  // From a ball of radius 1 to one of radius 1/2; then distances that are not symmetric.
  TriangleMesh ball = sphere(24), small = ball;
  for (double& x : small.vertices) x *= 0.5;
  CHECK(farthest_from(ball, small, 20000) == doctest::Approx(0.5).epsilon(0.01));
  TriangleMesh one_side = {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};
  CHECK(farthest_from(one_side, cube_of_12()) == doctest::Approx(0));
  CHECK(farthest_from(cube_of_12(), one_side) > 1);
}

}  // namespace powercell::test
