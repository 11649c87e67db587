// Measures of a few cells that are known.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <powercell/shapes.hpp>

#include "tests/solid/both_ways.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The unit cube without the cube of edge 1/2 in its middle.
Domain hollow_cube() {
  Random random(1);
  return volume_of(part_of(cube_tetrahedra(4, 0, random), [](const std::array<double, 3>& x) {
    return std::max({std::abs(x[0] - .5), std::abs(x[1] - .5), std::abs(x[2] - .5)}) > .25;
  }));
}

/// A torus about the z axis, of `around` times `across` planar trapezoids, with one vertex of each ring in
/// the plane of the axis and the middle circle.
Mesh ring(double radius, double tube, std::uint32_t around, std::uint32_t across) {
  Mesh mesh;
  for (std::uint32_t a = 0; a < around; ++a)
    for (std::uint32_t b = 0; b < across; ++b) {
      const double turn = 2 * std::numbers::pi, u = turn * a / around, v = turn * b / across;
      const double r = radius + tube * std::cos(v);
      mesh.vertices.insert(mesh.vertices.end(), {r * std::cos(u), r * std::sin(u), tube * std::sin(v)});
      const std::uint32_t here = a * across, next = (a + 1) % around * across, c = (b + 1) % across;
      mesh.elements.insert(mesh.elements.end(), {here + b, next + b, next + c, here + b, next + c, here + c});
    }
  return mesh;
}

/// Balls about the origin within each other: every second one is a cavity.
Mesh shells(const std::vector<double>& radii) {
  const TriangleMesh sphere = powercell::sphere(6);
  Mesh mesh;
  for (const double radius : radii) {
    const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
    for (const double x : sphere.vertices) mesh.vertices.push_back(radius * x);
    for (const std::uint32_t v : sphere.triangles) mesh.elements.push_back(first + v);
  }
  return mesh;
}

Diagram diagram_in(const Mesh& surface, const SeedArray& seeds) {
  Diagram diagram(double_device_of_tests(), Domain::solid(surface.vertices, surface.elements));
  diagram.set_seeds(seeds.view());
  return diagram;
}

}  // namespace

TEST_CASE("solid: a torus cut by planes through its axis") {
  if (!has_double()) return;
  constexpr double radius = 1, tube = 0.3, pi = std::numbers::pi;
  constexpr std::uint32_t around = 60, across = 17;
  const Mesh mesh = ring(radius, tube, around, across);
  const double profile = across * tube * tube * std::sin(2 * pi / across) / 2;
  for (const int n : {3, 4, 5, 12, 30}) {
    CAPTURE(n);
    SeedArray seeds;
    for (int k = 0; k < n; ++k) {  // bisectors pass between the rings of vertices
      const double angle = 2 * pi * ((k + 0.5) / n + 0.5 / around);
      seeds.push({radius * std::cos(angle), radius * std::sin(angle), 0}, 0);
    }
    Diagram diagram = diagram_in(mesh, seeds);
    for (const double m : diagram.measures().mass)
      CHECK(m == doctest::Approx(radius * profile * around * std::sin(2 * pi / around) / n).epsilon(1e-13));
    REQUIRE(diagram.adjacency().wall.size() == 2 * static_cast<std::size_t>(n));
    for (const double wall : diagram.adjacency().wall)
      CHECK(wall == doctest::Approx(profile * std::cos(pi / around)).epsilon(1e-13));
  }
}

TEST_CASE("solid: balls in ball shells cut in halves") {
  if (!has_double()) return;
  SeedArray seeds;
  seeds.push({0.11, 0.23, -0.07}, 0.01);
  seeds.push({-0.11, -0.23, 0.07}, 0.01);
  seeds.push({3, 0, 0}, 0);
  Diagram ball = diagram_in(shells({1}), seeds);
  const std::vector<std::vector<double>> all{{1, 0.5}, {1, 0.9, 0.6}, {1, 0.75, 0.5, 0.25, 0.125}};
  for (const std::vector<double>& radii : all) {
    double volume = 0, area = 0;
    for (std::size_t k = 0; k < radii.size(); ++k) {
      volume += (k % 2 ? -1 : 1) * std::pow(radii[k], 3);
      area += (k % 2 ? -1 : 1) * std::pow(radii[k], 2);
    }
    Diagram diagram = diagram_in(shells(radii), seeds);
    for (std::size_t i = 0; i < 2; ++i)
      CHECK(diagram.measures().mass[i] ==
            doctest::Approx(volume * ball.measures().domain_measure / 2).epsilon(1e-13));
    CHECK(diagram.measures().status[2] == SeedStatus::hidden);
    REQUIRE(diagram.adjacency().wall.size() == 2);
    CHECK(diagram.adjacency().wall[0] == doctest::Approx(area * ball.adjacency().wall[0]).epsilon(1e-13));
  }
}

TEST_CASE("solid: a hollow cube in one cell, wherever its seed lies") {
  if (!has_double()) return;
  for (const double x : {0.5, 0.05, -3.0}) {
    SeedArray seeds;
    seeds.push({x, 0.5, 0.5}, 0);
    const BothWays both = compute_both_ways(hollow_cube(), seeds);
    CHECK(both.by_boundary.mass[0] == doctest::Approx(7.0 / 8).epsilon(1e-14));
    CHECK(both.by_boundary.centroid[0] == doctest::Approx(0.5).epsilon(1e-14));
    // About the middle, 1/4 for the cube of edge 1; the smaller one has 2^-5 of that.
    const double about_middle = 0.25 * (1 - 1.0 / 32), shift = x - 0.5;
    CHECK(both.by_boundary.second_moment[0] ==
          doctest::Approx(about_middle + 7.0 / 8 * shift * shift).epsilon(1e-14));
  }
}

TEST_CASE("solid: two cells of a hollow cube") {
  if (!has_double()) return;
  // The wall at x = 0.4 is a square with a square hole.
  SeedArray seeds;
  seeds.push({0.1, 0.4, 0.6}, 0);
  seeds.push({0.7, 0.4, 0.6}, 0);
  const BothWays both = compute_both_ways(hollow_cube(), seeds);
  CHECK(both.by_boundary.mass[0] == doctest::Approx(0.4 - 0.15 / 4).epsilon(1e-14));
  CHECK(both.by_boundary.mass[1] == doctest::Approx(0.6 - 0.35 / 4).epsilon(1e-14));
  REQUIRE(both.walls_by_boundary.wall.size() == 2);
  CHECK(both.walls_by_boundary.wall[0] == doctest::Approx(0.75).epsilon(1e-14));
}

TEST_CASE("solid: a cell in the cavity is hidden, and the others have no wall with it") {
  if (!has_double()) return;
  SeedArray seeds;
  seeds.push({0.5, 0.5, 0.5}, 0);
  for (const double x : {-0.05, 1.05}) seeds.push({x, 0.5, 0.5}, 0);
  for (const double y : {-0.05, 1.05}) seeds.push({0.5, y, 0.5}, 0);
  for (const double z : {-0.05, 1.05}) seeds.push({0.5, 0.5, z}, 0);
  for (double& w : seeds.weights) w = 0;
  seeds.weights[0] = -0.2;  // its cell is the cube |x - 1/2| < 0.0932 about the middle
  const BothWays both = compute_both_ways(hollow_cube(), seeds);
  CHECK(both.by_boundary.status[0] == SeedStatus::hidden);
  CHECK(both.by_boundary.mass[0] == 0);
  for (std::size_t i = 1; i < 7; ++i)
    CHECK(both.by_boundary.mass[i] == doctest::Approx(7.0 / 48).epsilon(1e-13));
  CHECK(both.walls_by_boundary.offset[1] == 0);
}
