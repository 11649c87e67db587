// Unusual domains, sizes and positions that must give a correct diagram.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/diagram/check.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

SeedArray white_seeds(const Domain& domain, std::size_t n) {
  Random random(test_seed());
  return seeds_for(domain, Distribution::white, WeightRange::W1, n, random);
}

void move_mesh(Mesh& mesh, double scale, double shift) {
  for (double& x : mesh.vertices) x = shift + scale * x;
}

Parts moved(Parts parts, double scale, double shift) {
  const auto move = [&](Ring& ring) {
    for (auto& point : ring)
      for (double& x : point) x = shift + scale * x;
  };
  for (PolygonPart& part : parts) {
    move(part.outer);
    for (Ring& hole : part.holes) move(hole);
  }
  return parts;
}

void check_moved(double scale, double shift) {
  INFO(replay_hint());
  INFO("scale " << scale << ", shift " << shift);
  Mesh sphere = icosphere(1), ball = ball_tetrahedra(0);
  move_mesh(sphere, scale, shift);
  move_mesh(ball, scale, shift);
  const std::vector<double> low(3, shift), high(3, shift + scale);
  const NamedDomain domains[] = {{"polygon", Domain::polygon(moved(square_with_holes(), scale, shift))},
                                 {"sphere", surface_of(sphere)},
                                 {"ball", volume_of(ball)},
                                 {"box", Domain::box(low, high)}};
  for (const NamedDomain& named : domains) {
    INFO(named.name);
    check_everywhere(named.domain, white_seeds(named.domain, 60), Position::degenerate);
  }
}

/// Checks the sum of measures only: there are too many seeds or regions for brute force.
void check_partition(const Setup& setup, const Domain& domain, const SeedArray& seeds, double tolerance) {
  INFO(setup.name);
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds.view());
  CHECK(diagram.measures().relative_error() < tolerance);
  CHECK(diagram.measures().count(SeedStatus::ok) > 0);
}

}  // namespace

TEST_CASE("coordinates of size 1e-6") {
  check_moved(1e-6, 0);
}
TEST_CASE("coordinates of size 1e9") {
  check_moved(1e9, 0);
}
TEST_CASE("a domain far from the origin") {
  check_moved(1, 1e5);
  check_moved(1, -1e9);
}

TEST_CASE("a polygon with collinear and repeated points, closed, in either orientation") {
  INFO(replay_hint());
  Ring ring{{0, 0}, {0.5, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0.75, 1}, {0.5, 1}, {0, 1}, {0, 0.5}, {0, 0}};
  const Domain forwards = Domain::polygon(Parts{{ring, {}}});
  std::reverse(ring.begin(), ring.end());
  const Domain backwards = Domain::polygon(Parts{{ring, {}}});
  CHECK(forwards.measure() == doctest::Approx(1));
  CHECK(backwards.measure() == doctest::Approx(1));
  check_everywhere(forwards, white_seeds(forwards, 50), Position::general);
  check_everywhere(backwards, white_seeds(backwards, 50), Position::general);
}

TEST_CASE("many convex pieces") {
  INFO(replay_hint());
  const Domain domain = Domain::polygon(comb(40));
  check_everywhere(domain, white_seeds(domain, 60), Position::general);
}

TEST_CASE("a surface with slivers, flat triangles, duplicate and unused vertices") {
  INFO(replay_hint());
  Mesh mesh = wavy_patch(4);
  const auto first = static_cast<std::uint32_t>(mesh.vertex_count());
  // Duplicate vertices, an unused one, a needle of 1e-9, a triangle of area 0, a repeated corner.
  for (const std::size_t v : {0, 1}) {
    const double copy[3] = {mesh.vertices[3 * v], mesh.vertices[3 * v + 1], mesh.vertices[3 * v + 2]};
    mesh.vertices.insert(mesh.vertices.end(), copy, copy + 3);
  }
  mesh.vertices.insert(mesh.vertices.end(),
                       {0.2, 0.3, 0.9, 0.8, 0.3, 0.9, 0.5, 0.3 + 1e-9, 0.9, 7, 7, 7, 0.5, 0.3, 0.9});
  mesh.elements[0] = first;
  mesh.elements.insert(mesh.elements.end(),
                       {first + 2, first + 3, first + 4, first + 2, first + 3, first + 6, 3, 3, 4});
  const Domain domain = surface_of(mesh);
  CHECK(domain.region_count() == mesh.elements.size() / 3 - 2);
  check_everywhere(domain, white_seeds(domain, 50), Position::degenerate);
}

TEST_CASE("tetrahedra that are slivers, flat, or inverted") {
  INFO(replay_hint());
  for (const Setup& setup : all_setups()) {
    // As thin as the precision can distinguish from flat.
    const double height = setup.options.precision == Precision::float32 ? 0.02 : 1e-9;
    Mesh mesh;
    mesh.vertices = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.3, 1, 0.4, 0.3, -height, 0.3, 0.4, 0};
    // A good one; an inverted sliver on its other side; a flat one.
    mesh.elements = {0, 1, 2, 3, 0, 1, 2, 4, 0, 1, 2, 5};
    const Domain domain = volume_of(mesh);
    CHECK(domain.region_count() == 2);
    const SeedArray seeds = white_seeds(domain, 40);
    check_diagram(setup, domain, seeds, brute_force(domain.mesh(), seeds.view()), Position::degenerate);
  }
}

TEST_CASE("one region with very many seeds") {
  INFO(replay_hint());
  const std::size_t n = 100000;
  Random random(test_seed());
  for (const int d : {2, 3}) {
    INFO(d << "D");
    check_partition(main_setups().front(), unit_box(d),
                    random_seeds(Distribution::white, WeightRange::W1, n, d, random), 1e-12);
  }
}

TEST_CASE("very many regions with one seed, and with a few") {
  INFO(replay_hint());
  const Domain domain = surface_of(wavy_patch(400));
  for (const std::size_t n : {1, 10})
    for (const Setup& setup : main_setups()) check_partition(setup, domain, white_seeds(domain, n), 1e-12);
}
