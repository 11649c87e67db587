// Blue noise on surfaces whose sides are nearer to each other than the points: each side has its share.
#include "lib/applications/sampling/layers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/point_sets.hpp>
#include <powercell/sampling.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// A closed plate [0, 1]^2 x [0, thickness], with per_axis^2 squares on each side.
Mesh plate(int per_axis, double thickness) {
  Mesh mesh;
  const auto row = static_cast<std::uint32_t>(per_axis) + 1, side = row * row;
  for (const double z : {0.0, thickness})
    for (int i = 0; i <= per_axis; ++i)
      for (int j = 0; j <= per_axis; ++j)
        mesh.vertices.insert(mesh.vertices.end(),
                             {static_cast<double>(i) / per_axis, static_cast<double>(j) / per_axis, z});
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.elements.insert(mesh.elements.end(), {a, b, c, a, c, d});
  };
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * row + j; };
  const std::uint32_t last = row - 1;
  for (std::uint32_t i = 0; i < last; ++i) {
    for (std::uint32_t j = 0; j < last; ++j) {
      quad(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
      quad(side + at(i, j), side + at(i + 1, j), side + at(i + 1, j + 1), side + at(i, j + 1));
    }
    const auto rim = [&](std::uint32_t a, std::uint32_t b) { quad(a, b, side + b, side + a); };
    rim(at(i, 0), at(i + 1, 0));
    rim(at(i + 1, last), at(i, last));
    rim(at(0, i + 1), at(0, i));
    rim(at(last, i), at(last, i + 1));
  }
  return mesh;
}

/// Two spheres about the same centre.
Mesh hollow_sphere(double inner_radius) {
  Mesh mesh = icosphere(3);
  const Mesh outer = mesh;
  const auto count = static_cast<std::uint32_t>(outer.vertex_count());
  for (const double x : outer.vertices) mesh.vertices.push_back(inner_radius * x);
  for (const std::uint32_t v : outer.elements) mesh.elements.push_back(v + count);
  return mesh;
}

double spacing_of(double measure, double n) {
  return std::sqrt(measure / n);
}

SamplingResult sampled(const Domain& domain, std::size_t n, const Density& density = Density::constant(1)) {
  SamplingOptions options;
  options.random_seed = test_seed();
  options.density = density;
  const SamplingResult found = sample(test_device(), domain, n, options);
  CHECK(found.converged);
  CHECK(found.positions.size() == 3 * n);
  return found;
}

/// The points below a height, in the plane.
std::vector<double> below(const SamplingResult& found, double height) {
  std::vector<double> points;
  for (std::size_t k = 0; k < found.positions.size(); k += 3)
    if (found.positions[k + 2] < height)
      points.insert(points.end(), {found.positions[k], found.positions[k + 1]});
  return points;
}

double share(const SamplingResult& found, std::size_t layer) {
  return static_cast<double>(found.layers[layer]) / static_cast<double>(found.weights.size());
}

}  // namespace

TEST_CASE("both sides of a thin plate get their share of even points, whatever the triangles") {
  INFO(replay_hint());
  constexpr std::size_t n = 400;
  for (const int per_axis : {1, 12})
    for (const double thickness : {0.001, 0.1, 0.5}) {
      CAPTURE(per_axis);
      CAPTURE(thickness);
      const double t = thickness * spacing_of(2, n);
      const Domain domain = surface_of(plate(per_axis, t));
      const SamplingResult found = sampled(domain, n);
      REQUIRE(found.layers.size() == 2);
      CHECK(found.layers[0] + found.layers[1] == n);
      // The rim may go to either side, or some of it to each.
      const double sides = n / (2 + 4 * t), rim = 4 * t * sides;
      const std::vector<double> points = below(found, t / 2);
      const auto count = static_cast<double>(points.size() / 2);
      CHECK(count > sides - 3);
      CHECK(count < sides + rim + 3);
      const Spacing even = spacing(test_device(), unit_box(2), points);
      CHECK(even.mean > 0.84);
      CHECK(even.least > 0.5);
      CHECK(found.layer_spacing.mean == doctest::Approx(even.mean).epsilon(0.03));
      // The masses are those of power cells on the plate.
      Diagram diagram(test_device(), domain);
      diagram.set_seeds({3, found.positions, found.weights});
      const double mass = domain.measure() / n;
      for (const double m : diagram.measures().mass) CHECK(std::abs(m / mass - 1) < 2e-6);
      CHECK(found.apart.share > 0.03);
    }
}

TEST_CASE("a thick plate, a body without thin parts and the best quantiser have no layers") {
  INFO(replay_hint());
  constexpr std::size_t n = 200;
  const double spacing = spacing_of(2, n);
  const auto layers = [&](const Domain& domain) {
    return find_layers(domain, Density::constant(1), n, test_seed(), 1).count;
  };
  CHECK(layers(surface_of(plate(1, spacing))) == 1);
  CHECK(layers(surface_of(plate(10, spacing))) == 1);
  CHECK(layers(surface_of(plate(10, 0.4 * spacing))) == 2);
  CHECK(layers(surface_of(torus(24, 12))) == 1);
  CHECK(sampled(surface_of(plate(4, spacing)), n).layers.empty());
  SamplingOptions options;
  options.mode = SamplingMode::quantise;
  options.iterations = 2;
  options.movement = 0;
  CHECK(sample(test_device(), surface_of(plate(4, 0.1 * spacing)), n, options).layers.empty());
}

TEST_CASE("both surfaces of a hollow sphere get their share") {
  INFO(replay_hint());
  const double inner = 1 - 0.1 * spacing_of(8 * 3.14159, 300);
  const SamplingResult found = sampled(surface_of(hollow_sphere(inner)), 300);
  REQUIRE(found.layers.size() == 2);
  std::size_t outside = 0;
  for (std::size_t k = 0; k < found.positions.size(); k += 3)
    outside += std::hypot(found.positions[k], found.positions[k + 1], found.positions[k + 2]) >
               (1 + inner) / 2 - 0.01;  // faces of the outer sphere are within 0.01 of it
  CHECK(std::abs(static_cast<double>(outside) - 300 / (1 + inner * inner)) < 3);
}

TEST_CASE("layers have their shares of a density") {
  INFO(replay_hint());
  const double t = 0.2 * spacing_of(2, 300);
  const Mesh mesh = plate(6, t);
  const Domain domain = surface_of(mesh);
  std::vector<double> nodal;
  for (std::size_t k = 2; k < mesh.vertices.size(); k += 3) nodal.push_back(mesh.vertices[k] > 0 ? 3 : 1);
  for (const Density& density :
       {Density::function([&](const std::array<double, 3>& x) { return x[2] > t / 2 ? 3.0 : 1.0; }),
        Density::nodal(nodal)}) {
    const SamplingResult found = sampled(domain, 300, density);
    REQUIRE(found.layers.size() == 2);
    const auto count = static_cast<double>(below(found, t / 2).size() / 2);
    CHECK(count / 300 == doctest::Approx(0.25).epsilon(0.1));
    CHECK(std::min(share(found, 0), share(found, 1)) == doctest::Approx(0.25).epsilon(0.2));
  }
}

TEST_CASE("sheets that do not face each other share a layer") {
  INFO(replay_hint());
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles;
  const auto add = [&](double x, double z) {
    const auto base = static_cast<std::uint32_t>(vertices.size() / 3);
    vertices.insert(vertices.end(), {x, 0, z, x + 1, 0, z, x + 1, 1, z, x, 1, z});
    triangles.insert(triangles.end(), {base, base + 1, base + 2, base, base + 2, base + 3});
  };
  const auto layers = [&] {
    return find_layers(Domain::surface(vertices, triangles), Density::constant(1), 300, test_seed(), 1);
  };
  add(0, 0);
  add(1.001, 0);  // beyond a narrow gap
  CHECK(layers().count == 1);
  const double distance = 0.5 * spacing_of(4, 300);
  add(0, distance);
  add(0, 2 * distance);
  const Layers found = layers();
  REQUIRE(found.count == 2);
  REQUIRE(found.of_region.size() == 8);
  CHECK(found.of_region[0] == found.of_region[6]);
  CHECK(found.of_region[0] != found.of_region[4]);
  CHECK(found.of_region[4] == found.of_region[5]);
}
