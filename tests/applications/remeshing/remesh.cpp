// remesh() as a whole: topology and quality of the results, kept edges, sizing, determinism, progress,
// refusals.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>
#include <powercell/remeshing.hpp>

#include "tests/applications/remeshing/shapes.hpp"

namespace powercell::test {
namespace {

double diagonal(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double low = 1e300, high = -1e300;
    for (std::size_t v = k; v < mesh.vertices.size(); v += 3) {
      low = std::min(low, mesh.vertices[v]);
      high = std::max(high, mesh.vertices[v]);
    }
    sum += (high - low) * (high - low);
  }
  return std::sqrt(sum);
}

/// Checks what holds for every result: number of vertices, topology, vertices on the input.
void check_result(const TriangleMesh& input, const RemeshResult& result, std::size_t count) {
  const MeshQuality before = mesh_quality(input.vertices, input.triangles);
  const MeshQuality after = mesh_quality(result.mesh.vertices, result.mesh.triangles);
  CHECK(after.vertices == count);
  CHECK(result.mesh.vertices.size() == 3 * count);
  CHECK(result.fixed.size() == count);
  CHECK(result.sizing.size() == count);
  CHECK(after.manifold);
  CHECK(after.euler_characteristic == before.euler_characteristic);
  CHECK(after.boundary_loops == before.boundary_loops);
  // Each vertex lies on the input.
  TriangleMesh vertices_only = result.mesh;
  vertices_only.triangles.clear();
  for (std::uint32_t v = 0; v < count; ++v)
    vertices_only.triangles.insert(vertices_only.triangles.end(), {v, v, v});
  CHECK(farthest_from(vertices_only, input, 1) < 1e-12 * diagonal(input));
}

ErrorCode code_of(const TriangleMesh& mesh, const RemeshOptions& options) {
  try {
    remesh(mesh.vertices, mesh.triangles, options);
  } catch (const Error& error) {
    return error.code();
  }
  FAIL("no error");
  return ErrorCode::internal;
}

/// Checks the results of both methods.
/// \param worst_angle  lower bound of the angles, degrees
void check_methods(const TriangleMesh& mesh, std::size_t count, double worst_angle) {
  for (const RemeshMethod method : {RemeshMethod::farthest_point, RemeshMethod::transport}) {
    CAPTURE(static_cast<int>(method));
    RemeshOptions options;
    options.method = method;
    options.count = count;
    options.rounds = 3;
    const RemeshResult result = remesh(mesh.vertices, mesh.triangles, options);
    check_result(mesh, result, count);
    const MeshQuality quality = mesh_quality(result.mesh.vertices, result.mesh.triangles);
    CHECK(quality.angle_min > worst_angle);
    CHECK(quality.below_30 == 0);
    CHECK(quality.regular >= 0.987);
    CHECK(farthest_from(mesh, result.mesh, 20000) < 0.01 * diagonal(mesh));
    CHECK(farthest_from(result.mesh, mesh, 20000) < 0.01 * diagonal(mesh));
  }
}

/// Remeshes and returns the reported fractions.
std::vector<double> reported_progress(const TriangleMesh& mesh, RemeshOptions options) {
  std::vector<double> fractions;
  options.progress = [&](double done) {
    fractions.push_back(done);
    return true;
  };
  remesh(mesh.vertices, mesh.triangles, options);
  return fractions;
}

}  // namespace

TEST_CASE("smooth surfaces, open and closed, get meshes of the same topology and good quality") {
  for (const NamedMesh& shape : smooth_meshes()) {
    CAPTURE(shape.name);
    check_methods(shape.mesh, 600, 32.6);
  }
}

TEST_CASE("ten rounds of farthest-point optimisation reach a quality of 0.6, 0.92 on average") {
  double sum = 0;
  for (const NamedMesh& shape : smooth_meshes()) {
    CAPTURE(shape.name);
    RemeshOptions options;
    options.count = 600;
    options.rounds = 10;
    const RemeshResult result = remesh(shape.mesh.vertices, shape.mesh.triangles, options);
    const MeshQuality quality = mesh_quality(result.mesh.vertices, result.mesh.triangles);
    CHECK(quality.q_min > 0.6);
    CHECK(quality.q_mean > 0.91);
    sum += quality.q_mean;
  }
  CHECK(sum / static_cast<double>(smooth_meshes().size()) > 0.92);
}

TEST_CASE("sharp edges and corners are kept") {
  const TriangleMesh cube = cube_of_12();
  for (const RemeshMethod method : {RemeshMethod::farthest_point, RemeshMethod::transport}) {
    RemeshOptions options;
    options.method = method;
    options.count = 500;
    options.rounds = 3;
    const RemeshResult result = remesh(cube.vertices, cube.triangles, options);
    check_result(cube, result, options.count);
    // A mesh that keeps all edges of the cube covers the same surface.
    CHECK(farthest_from(result.mesh, cube, 20000) < 1e-12);
    CHECK(farthest_from(cube, result.mesh, 20000) < 1e-12);
    for (std::size_t c = 0; c < 8; ++c) {
      bool found = false;
      for (std::size_t v = 0; v < options.count && !found; ++v)
        found = result.fixed[v] &&
                std::equal(&cube.vertices[3 * c], &cube.vertices[3 * c] + 3, &result.mesh.vertices[3 * v]);
      CHECK(found);
    }
  }
}

TEST_CASE("unused vertices change nothing") {
  const TriangleMesh torus = small_torus();
  TriangleMesh more = torus;
  for (std::uint32_t& v : more.triangles) v += 2;
  more.vertices.insert(more.vertices.begin(), {1, -1e300, 2, 5e3, 0, 0});
  RemeshOptions options;
  options.count = 300;
  options.rounds = 2;
  CHECK(remesh(more.vertices, more.triangles, options).mesh.vertices ==
        remesh(torus.vertices, torus.triangles, options).mesh.vertices);
}

TEST_CASE("edges are shorter where the curvature is larger") {
  // A flat sheet with one bump.
  TriangleMesh sheet = wavy_sheet();
  for (std::size_t k = 0; k < sheet.vertices.size(); k += 3) {
    const double x = sheet.vertices[k] - 0.5, y = sheet.vertices[k + 1] - 0.5;
    sheet.vertices[k + 2] = 0.1 * std::exp(-40 * (x * x + y * y));
  }
  RemeshOptions options;
  options.count = 800;
  options.rounds = 3;
  const RemeshResult result = remesh(sheet.vertices, sheet.triangles, options);
  const auto share_near = [&](double radius) {
    std::size_t inside = 0;
    for (std::size_t v = 0; v < options.count; ++v)
      if (std::hypot(result.mesh.vertices[3 * v] - 0.5, result.mesh.vertices[3 * v + 1] - 0.5) < radius)
        ++inside;
    return static_cast<double>(inside) / static_cast<double>(options.count);
  };
  CHECK(share_near(0.2) > 2 * 0.04 * 3.14159);
  options.contrast = 1;
  const RemeshResult even = remesh(sheet.vertices, sheet.triangles, options);
  const auto [least, most] = std::minmax_element(even.sizing.begin(), even.sizing.end());
  CHECK(*most / *least == doctest::Approx(1));
}

TEST_CASE("the optimisation spreads the points, and the same random seed gives the same mesh") {
  const TriangleMesh ring = small_torus();
  RemeshOptions options;
  options.count = 400;
  options.rounds = 8;
  options.contrast = 1;
  const RemeshResult result = remesh(ring.vertices, ring.triangles, options);
  REQUIRE(!result.least_spacing.empty());
  CHECK(*std::max_element(result.least_spacing.begin(), result.least_spacing.end()) > 0.8);
  const RemeshResult again = remesh(ring.vertices, ring.triangles, options);
  CHECK(again.mesh.vertices == result.mesh.vertices);
  CHECK(again.mesh.triangles == result.mesh.triangles);
  options.random_seed = 2;
  CHECK(remesh(ring.vertices, ring.triangles, options).mesh.vertices != result.mesh.vertices);
}

TEST_CASE("surfaces far from the origin, of any scale") {
  for (const double scale : {1e-6, 1e3}) {
    TriangleMesh ball = bumpy_ball();
    for (double& x : ball.vertices) x = 1e4 * scale + scale * x;
    RemeshOptions options;
    options.count = 300;
    options.rounds = 1;
    const RemeshResult result = remesh(ball.vertices, ball.triangles, options);
    check_result(ball, result, options.count);
  }
}

TEST_CASE("the method transport spreads the points and can be interrupted") {
  const TriangleMesh ring = small_torus();
  RemeshOptions options;
  options.method = RemeshMethod::transport;
  options.count = 300;
  options.rounds = 4;
  options.relaxations = 0;
  options.contrast = 1;
  // Without relaxation the triangles are those of the dual, about equal in area as the cells are.
  const RemeshResult result = remesh(ring.vertices, ring.triangles, options);
  check_result(ring, result, options.count);
  REQUIRE(result.least_spacing.size() == 1);
  CHECK(result.least_spacing.front() > 0.5);
  options.progress = [](double) { return false; };
  CHECK(code_of(ring, options) == ErrorCode::interrupted);
}

TEST_CASE("progress is reported from 0 to 1, also for few points, and each report can interrupt") {
  const TriangleMesh ring = small_torus();
  RemeshOptions options;
  options.count = 60;
  options.rounds = 4;
  const std::vector<double> reports = reported_progress(ring, options);
  REQUIRE(reports.size() > 4);
  CHECK(std::is_sorted(reports.begin(), reports.end()));
  CHECK(reports.front() == 0);
  const auto between = [&](double low, double high) {
    return std::count_if(reports.begin(), reports.end(),
                         [&](double done) { return low < done && done < high; });
  };
  CHECK(between(0.02, 0.9) >= 3);   // the rounds
  CHECK(between(0.9, 0.97) >= 15);  // the relaxations
  CHECK(between(0.97, 1) >= 1);
  CHECK(reports.back() == 1);
  for (std::size_t call = 0; call < reports.size(); ++call) {
    std::size_t calls = 0;
    options.progress = [&](double) { return calls++ < call; };
    CHECK(code_of(ring, options) == ErrorCode::interrupted);
    CHECK(calls == call + 1);
  }
}

TEST_CASE("progress is reported within each step for many points") {
  const TriangleMesh ring = small_torus();
  RemeshOptions options;
  options.count = 4000;
  options.rounds = 0;
  const std::vector<double> reports = reported_progress(ring, options);
  CHECK(std::is_sorted(reports.begin(), reports.end()));
  for (const double from : {0.02, 0.9, 0.97}) {  // first points; reaching the count and relaxation; fitting
    CAPTURE(from);
    const auto calls = std::count_if(reports.begin(), reports.end(),
                                     [&](double done) { return from <= done && done < from + 0.03; });
    CHECK(calls > 15);
  }
}

TEST_CASE("invalid options, impossible counts and surfaces that are too thin are refused") {
  RemeshOptions options;
  options.count = 3;
  CHECK(code_of(cube_of_12(), options) == ErrorCode::invalid_argument);
  options.count = 7;  // fewer than corners
  CHECK(code_of(cube_of_12(), options) == ErrorCode::invalid_argument);
  options.count = 5;  // no torus has fewer than 7 vertices
  CHECK(code_of(small_torus(), options) == ErrorCode::invalid_argument);
  options.count = 100;
  options.gradation = 0;
  CHECK(code_of(cube_of_12(), options) == ErrorCode::invalid_argument);
  options.gradation = 0.2;
  options.contrast = 0.5;
  CHECK(code_of(cube_of_12(), options) == ErrorCode::invalid_argument);
  options.contrast = 2;
  options.progress = [](double) { return false; };
  options.count = 2000;
  CHECK(code_of(small_torus(), options) == ErrorCode::interrupted);
  options = {};
  options.count = 100;  // fewer than the boundary of a ribbon needs
  const TriangleMesh ribbon{{0, 0, 0, 1, 0, 0, 1, 1e-8, 0, 0, 1e-8, 0}, {0, 1, 2, 0, 2, 3}};
  CHECK(code_of(ribbon, options) == ErrorCode::invalid_argument);
  options.sharp_angle = 180;  // no kept edges; the spacing would cut a needle into millions of triangles
  TriangleMesh needle{{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
                      {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};
  for (std::size_t k = 0; k < needle.vertices.size(); k += 3) needle.vertices[k] *= 1e9;
  CHECK(code_of(needle, options) == ErrorCode::invalid_domain);
}

}  // namespace powercell::test
