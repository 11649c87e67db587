// Cells at the boundary of tetrahedral meshes, which are computed from the boundary, or by tetrahedra where
// seeds tie with it.
#include <doctest/doctest.h>

#include <algorithm>
#include <powercell/diagram.hpp>

#include "lib/diagram/state.hpp"
#include "tests/diagram/check.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Point = std::array<double, 3>;

void add(Mesh& to, const Mesh& from, const Point& by) {
  const auto first = static_cast<std::uint32_t>(to.vertex_count());
  for (std::size_t k = 0; k < from.vertices.size(); ++k) to.vertices.push_back(from.vertices[k] + by[k % 3]);
  for (const std::uint32_t v : from.elements) to.elements.push_back(first + v);
}

/// The number of pairs with tetrahedra that a diagram in double precision clips; 0 if no setup has that.
std::size_t tetrahedra_of(const Domain& domain, const SeedArray& seeds) {
  for (const test::Setup& setup : main_setups()) {
    Diagram::State diagram(setup.device, domain, setup.options);
    if (!diagram.setup.boundary) continue;
    diagram.set_seeds(seeds.view());
    diagram.compute({});
    const std::vector<std::uint32_t>& regions = diagram.integrals->pairs.region;
    return static_cast<std::size_t>(std::count_if(
        regions.begin(), regions.end(), [&](std::uint32_t r) { return r < domain.region_count(); }));
  }
  return 0;
}

SeedArray white(std::size_t n, Random& random) {
  return random_seeds(Distribution::white, WeightRange::W1, n, 3, random,
                      Box{{-.1, -.1, -.1}, {1.1, 1.1, 1.1}});
}

}  // namespace

TEST_CASE("cells at the boundary: convex domains") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = white(120, random);
  const Domain cube = volume_of(cube_tetrahedra(3, 0.2, random));
  check_everywhere(cube, seeds, Position::general);
  CHECK(tetrahedra_of(cube, seeds) == 0);
  // Twelve hundred planes; a cell meets up to a few dozen of them.
  check_everywhere(volume_of(ball_tetrahedra(2)), white(60, random), Position::general);
}

TEST_CASE("cells at the boundary: domains that are not convex") {
  INFO(replay_hint());
  Random random(test_seed());
  const Mesh cube = cube_tetrahedra(4, 0, random);
  const Mesh corner_off = part_of(cube, [](const Point& x) {
    return std::max({x[0], x[1], x[2]}) < 0.5 || std::min({x[0], x[1], x[2]}) < 0.5;
  });
  const Mesh hollow = part_of(cube, [](const Point& x) {
    return std::max({std::abs(x[0] - .5), std::abs(x[1] - .5), std::abs(x[2] - .5)}) > .25;
  });
  // Two slabs with a gap between them.
  const Mesh slabs = part_of(cube, [](const Point& x) { return x[0] < 0.25 || x[0] > 0.5; });
  for (const Mesh& mesh : {corner_off, hollow, slabs}) {
    const SeedArray seeds = white(60, random);
    check_everywhere(volume_of(mesh), seeds, Position::general);
    CHECK(tetrahedra_of(volume_of(mesh), seeds) == 0);
  }
}

TEST_CASE("cells at the boundary: blocks that touch without sharing vertices") {
  INFO(replay_hint());
  Random random(test_seed());
  // The faces between the blocks are boundary on both sides, coplanar, with triangles that cross each other.
  Mesh blocks = part_of(cube_tetrahedra(4, 0, random), [](const Point& x) { return x[0] < 0.5; });
  Mesh other = part_of(cube_tetrahedra(6, 0, random), [](const Point& x) { return x[0] > 0.5; });
  add(blocks, other, {0, 0, 0});
  const SeedArray seeds = white(80, random);
  const Domain domain = volume_of(blocks);
  REQUIRE(std::abs(domain.measure() - 1) < 1e-12);
  check_everywhere(domain, seeds, Position::general);
}

TEST_CASE("cells at the boundary: facets in bisectors of the seeds") {
  // The walls of a grid of seeds lie in the faces of the cube and outside.
  Random random(1);
  const Domain cube = volume_of(cube_tetrahedra(3, 0, random));
  SeedArray seeds;
  seeds.dimension = 3;
  for (int k = 0; k < 5 * 5 * 5; ++k)
    seeds.push({(k % 5) * 0.5 - 0.25, (k / 5 % 5) * 0.5 - 0.25, (k / 25) * 0.5 - 0.25}, 0);
  check_everywhere(cube, seeds, Position::degenerate);
}
