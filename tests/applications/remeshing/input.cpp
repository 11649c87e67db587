// The surface made of the input: refusals and their messages, orientation, refinement, curvature, sizing,
// curves.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <powercell/error.hpp>
#include <powercell/remeshing.hpp>

#include "lib/applications/remeshing/curves.hpp"
#include "lib/applications/remeshing/sizing.hpp"
#include "tests/applications/remeshing/surface_from.hpp"
#include "tests/support/meshes.hpp"

namespace powercell::test {
namespace {

using namespace remeshing;

std::string refusal(const TriangleMesh& mesh, bool repair = true) {
  RemeshOptions options;
  options.repair = repair;
  try {
    remesh(mesh.vertices, mesh.triangles, options);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_domain);
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("without repair, surfaces that are not manifolds are refused, with the place") {
  const Mesh pages = book(3);
  CHECK(says(refusal({pages.vertices, pages.elements}, false), "belongs to 3 triangles"));
  CHECK(says(refusal({{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1}, {0, 1, 2, 1, 0, 3, 0, 1, 4}}, false),
             "the edge between vertices 0 and 1 belongs to 3 triangles"));
  // Two triangles that share only a corner.
  CHECK(says(refusal({{0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0}, {0, 1, 2, 0, 3, 4}}, false),
             "sheets touch at vertex 0"));
  // A band of five triangles with a half turn.
  const double a = 2 * std::numbers::pi / 5;
  TriangleMesh moebius;
  for (int k = 0; k < 5; ++k)
    moebius.vertices.insert(moebius.vertices.end(), {std::cos(a * k), std::sin(a * k), 0.1 * k * k});
  moebius.triangles = {0, 1, 2, 1, 2, 3, 2, 3, 4, 3, 4, 0, 4, 0, 1};
  CHECK(says(refusal(moebius), "cannot be oriented"));
}

TEST_CASE("other invalid input is refused") {
  const std::vector<double> square = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0};
  CHECK(says(refusal({square, {}}), "no triangles"));
  CHECK(says(refusal({square, {0, 1, 9}}), "triangle 0: vertex index 9 is out of range, there are 4"));
  CHECK(says(refusal({square, {0, 1, 2, 0, 1, 3}}, false), "triangle 1 has no area"));
  CHECK(says(refusal({square, {0, 1}}), "triangles need 3 vertex indices each"));
  std::vector<double> infinite = square;
  infinite[4] = INFINITY;
  CHECK(says(refusal({infinite, {0, 1, 2}}), "vertex 1: coordinate y is inf"));
  std::vector<double> large = square;
  large[5] = 1e101;
  CHECK(says(refusal({large, {0, 1, 2}}), "1e+101: outside"));
  CHECK_THROWS_AS(mesh_quality(large, std::vector<std::uint32_t>{0, 1, 2}), Error);
}

TEST_CASE("triangles are oriented consistently") {
  TriangleMesh mesh = cube_of_12();
  std::swap(mesh.triangles[3], mesh.triangles[4]);
  const Surface surface = surface_from(mesh);
  CHECK(surface.euler_characteristic() == 2);
  CHECK(boundary_loops(surface) == 0);
  double volume = 0;
  for (std::uint32_t t = 0; t < surface.size(); ++t)
    volume += dot(surface.corner(t, 0), cross(surface.corner(t, 1), surface.corner(t, 2))) / 6;
  CHECK(std::fabs(volume) == doctest::Approx(1));
}

TEST_CASE("refinement keeps area, topology, sharp edges and linear values") {
  for (const TriangleMesh& mesh : {cube_of_12(), wavy_sheet(), tube()}) {
    const Surface surface = surface_from(mesh);
    std::vector<double> value;
    const auto linear = [](Vec x) { return 1 + x.x - 2 * x.y + 3 * x.z; };
    for (const Vec v : surface.vertex) value.push_back(linear(v));
    const Surface fine = refined(surface, 0.07, value);
    CHECK(fine.area() == doctest::Approx(surface.area()).epsilon(1e-12));
    CHECK(fine.euler_characteristic() == surface.euler_characteristic());
    CHECK(boundary_loops(fine) == boundary_loops(surface));
    double kept = 0, kept_before = 0, longest = 0;
    for (const auto& [s, sum] : {std::pair{&fine, &kept}, {&surface, &kept_before}})
      for (std::uint32_t t = 0; t < s->size(); ++t)
        for (int k = 0; k < 3; ++k) {
          const double length = norm(s->corner(t, (k + 1) % 3) - s->corner(t, k));
          if (s == &fine) longest = std::max(longest, length);
          if (s->kept[t][static_cast<std::size_t>(k)]) *sum += length;
        }
    CHECK(longest <= 0.07);
    CHECK(kept == doctest::Approx(kept_before).epsilon(1e-12));
    double off = 0;
    for (std::size_t v = 0; v < fine.vertex.size(); ++v)
      off = std::max(off, std::fabs(value[v] - linear(fine.vertex[v])));
    CHECK(off < 1e-12);
  }
}

TEST_CASE("curvatures of sphere and torus agree with the exact ones") {
  const Surface ball = surface_from(sphere(20));
  const Curvature round = curvature(ball);
  for (std::size_t v = 0; v < ball.vertex.size(); ++v) {
    CHECK(round.mean[v] == doctest::Approx(1).epsilon(0.05));
    CHECK(round.largest[v] == doctest::Approx(1).epsilon(0.25));
  }
  // |H| = (1/r + cos t / (R + r cos t)) / 2 and the largest principal curvature is 1/r.
  const Surface ring = surface_from(powercell::torus(48));
  const Curvature bent = curvature(ring);
  for (std::size_t v = 0; v < ring.vertex.size(); ++v) {
    const Vec x = ring.vertex[v];
    const double radial = std::hypot(x.x, x.y), cosine = (radial - 1) / 0.4;
    CHECK(bent.mean[v] == doctest::Approx((2.5 + cosine / radial) / 2).epsilon(0.03));
    CHECK(bent.largest[v] == doctest::Approx(2.5).epsilon(0.05));
  }
}

TEST_CASE("even spacing gives the requested number of vertices, and room for kept edges") {
  for (const TriangleMesh& mesh : {sphere(8), wavy_sheet(), tube()}) {
    const Surface surface = surface_from(mesh);
    const std::vector<double> even(surface.vertex.size(), even_spacing(surface, 700));
    CHECK(vertices_for(surface, even) - surface.euler_characteristic() == doctest::Approx(700));
  }
  const Surface cube = surface_from(cube_of_12());  // twelve edges, each between two triangles
  CHECK(even_spacing(cube, 1) == doctest::Approx(12));
}

TEST_CASE("the sizing respects the gradation and gives the requested number of vertices") {
  for (const double gradation : {0.05, 0.3}) {
    const Surface surface = surface_from(bumpy_ball());
    const std::vector<double> shape = relative_sizing(surface, 0.1, 4);
    CHECK(*std::min_element(shape.begin(), shape.end()) == 1);
    CHECK(*std::max_element(shape.begin(), shape.end()) <= 4 + 1e-12);
    CHECK(*std::max_element(shape.begin(), shape.end()) > 1.3);
    const Sizing sizing = scaled_sizing(surface, shape, gradation, 1500);
    CHECK(vertices_for(surface, sizing.h) == doctest::Approx(1500).epsilon(0.003));
    for (const auto& row : surface.triangle)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = row[k], b = row[(k + 1) % 3];
        const double length = norm(surface.vertex[a] - surface.vertex[b]);
        CHECK(std::fabs(sizing.h[a] - sizing.h[b]) <= gradation * length * (1 + 1e-9));
      }
  }
}

TEST_CASE("curves run from corner to corner or are closed") {
  const Surface cube = surface_from(cube_of_12());
  const std::vector<Curve> edges = kept_curves(cube, 45);
  CHECK(edges.size() == 12);
  for (const Curve& c : edges) {
    CHECK_FALSE(c.closed);
    CHECK(c.length() == doctest::Approx(1));
  }
  const std::vector<Curve> ends = kept_curves(surface_from(tube()), 45);
  CHECK(ends.size() == 2);
  for (const Curve& c : ends) CHECK(c.closed);
  CHECK(kept_curves(surface_from(wavy_sheet()), 45).size() == 4);
  CHECK(kept_curves(surface_from(small_torus()), 45).empty());

  const Sizing even{std::vector<double>(cube.vertex.size(), 0.1), 1};
  const std::vector<double> seeds = seeds_along(even, edges.front(), 1);
  CHECK(seeds.size() == 11);
  for (std::size_t k = 0; k < seeds.size(); ++k)
    CHECK(seeds[k] == doctest::Approx(0.1 * static_cast<double>(k)));
}

}  // namespace powercell::test
