// ConvexDiagram, the diagram of small groups, compared with powercell::Diagram, an independent
// implementation.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <powercell/diagram.hpp>
#include <powercell/shapes.hpp>

#include "lib/applications/treemap/convex_diagram.hpp"
#include "tests/applications/treemap/made_trees.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;
using treemap_detail::Columns;
using treemap_detail::ConvexDiagram;

namespace {

Columns columns(const SeedArray& seeds) {
  Columns c;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    c.x.push_back(seeds.coordinate(i, 0));
    c.y.push_back(seeds.coordinate(i, 1));
  }
  return c;
}

Columns columns(const Ring& ring) {
  Columns c;
  for (const auto& p : ring) {
    c.x.push_back(p[0]);
    c.y.push_back(p[1]);
  }
  return c;
}

std::map<std::uint32_t, double> walls_of(const ConvexDiagram& diagram, std::size_t i) {
  std::map<std::uint32_t, double> sum;
  const treemap_detail::Walls walls = diagram.walls();
  for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k)
    sum[walls.neighbor[k]] += walls.wall[k];
  return sum;
}

void check_same(ConvexDiagram& own, Diagram& twin, double scale) {
  const Measures& measures = twin.measures();
  const Adjacency& adjacency = twin.adjacency();
  const double loose = 1e-11 * scale;
  for (std::size_t i = 0; i < own.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(own.mass()[i] - measures.mass[i]) <= loose * scale);
    if (measures.mass[i] > 1e-4 * scale * scale) {
      CHECK(std::fabs(own.centroid().x[i] - measures.centroid[2 * i]) <= 1e3 * loose);
      CHECK(std::fabs(own.centroid().y[i] - measures.centroid[2 * i + 1]) <= 1e3 * loose);
    }
    std::map<std::uint32_t, double> walls = walls_of(own, i);
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k)
      walls[adjacency.neighbor[k]] -= adjacency.wall[k];
    for (const auto& [j, difference] : walls) CHECK(std::fabs(difference) <= 1e2 * loose);
  }
}

/// Scales the weights so that no cell is empty: no seed is inside the disc of another.
void shrink_weights(SeedArray& seeds) {
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    double nearest = 1e300;
    for (std::size_t j = 0; j < seeds.size(); ++j) {
      if (j == i) continue;
      nearest = std::min(nearest, std::pow(seeds.coordinate(i, 0) - seeds.coordinate(j, 0), 2) +
                                      std::pow(seeds.coordinate(i, 1) - seeds.coordinate(j, 1), 2));
    }
    seeds.weights[i] *= nearest;
  }
}

void compare(const Ring& outline, SeedArray seeds, const Setup& setup, double scale = 1) {
  PolygonPart part;
  part.outer = outline;
  Diagram twin(setup.device, Domain::polygon({&part, 1}), setup.options);
  twin.set_seeds(seeds.view());
  ConvexDiagram own;
  own.set_outline(columns(outline));
  own.set_seeds(columns(seeds), false);
  REQUIRE(own.compute(seeds.weights, {}));
  check_same(own, twin, scale);
  // Again with other weights, starting from the neighbours of the first diagram.
  for (double& w : seeds.weights) w *= 0.3;
  twin.set_weights(seeds.weights);
  REQUIRE(own.compute(seeds.weights, {}));
  check_same(own, twin, scale);
}

const Ring kite = {{0.1, 0}, {1, 0.4}, {0.9, 1}, {0, 0.7}};

Ring in_unit_square(const Ring& ring) {
  Ring moved;
  for (const auto& p : ring) moved.push_back({0.5 + 0.5 * p[0], 0.5 + 0.5 * p[1]});
  return moved;
}

}  // namespace

TEST_CASE("weighted random seeds in a square, a kite and a circle agree with Diagram") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Setup& setup : main_setups())
    for (const Ring& outline : {square, kite, in_unit_square(disk(90))})
      for (const std::size_t n : {2u, 3u, 17u, 64u, 300u, 1500u}) {
        CAPTURE(n);
        SeedArray seeds = scatter(Distribution::white, n, 2, {{0.3, 0.3, 0}, {0.7, 0.7, 0}}, random);
        for (double& w : seeds.weights) w = random.uniform(-0.4, 0.4);
        shrink_weights(seeds);
        compare(outline, seeds, setup);
      }
}

TEST_CASE("grids, where four cells meet in a point, agree with Diagram") {
  for (const int per_axis : {2, 5, 16}) compare(square, grid(per_axis, 2), main_setups().front());
}

TEST_CASE("a cell with 400 neighbours agrees with Diagram") {
  Random random(test_seed());
  SeedArray seeds{2, {0.5, 0.5}, {0.16}};
  for (int k = 0; k < 400; ++k) {
    const double angle = 2 * std::acos(-1.0) * (k + random.uniform(0, 0.3)) / 400;
    seeds.push({0.5 + 0.45 * std::cos(angle), 0.5 + 0.45 * std::sin(angle)}, 0);
  }
  compare(square, seeds, main_setups().front());
}

TEST_CASE("very small and very large outlines agree with Diagram") {
  Random random(test_seed());
  for (const double size : {1e-6, 1e6}) {
    SeedArray seeds = scatter(Distribution::white, 50, 2, {}, random);
    Ring outline = square;
    for (auto& p : outline) p = {p[0] * size, p[1] * size};
    for (double& x : seeds.positions) x *= size;
    compare(outline, seeds, main_setups().front(), size);
  }
}

TEST_CASE("a cell that is empty or too small is reported") {
  ConvexDiagram diagram;
  diagram.set_outline(columns(square));
  const Columns seeds{{0.25, 0.75}, {0.5, 0.5}};
  diagram.set_seeds(seeds, false);
  const std::vector<double> equal = {0, 0}, heavy = {0, 1}, least = {0.4, 0.6}, low = {0.4, 0.4};
  CHECK_FALSE(diagram.compute(heavy, {}));
  CHECK_FALSE(diagram.compute(equal, least));
  REQUIRE(diagram.compute(equal, low));
  CHECK(diagram.mass()[0] == doctest::Approx(0.5).epsilon(1e-15));
  CHECK(walls_of(diagram, 1).at(0) == doctest::Approx(1).epsilon(1e-15));
}

TEST_CASE("the polygons of the vertices have the areas of the cells") {
  Random random(test_seed());
  ConvexDiagram diagram;
  diagram.set_outline(columns(kite));
  SeedArray seeds = scatter(Distribution::white, 80, 2, {{0.3, 0.3, 0}, {0.7, 0.7, 0}}, random);
  diagram.set_seeds(columns(seeds), false);
  REQUIRE(diagram.compute(seeds.weights, {}));
  std::vector<std::uint64_t> offset;
  std::vector<double> v;
  diagram.compute_vertices(seeds.weights, offset, v);
  REQUIRE(offset.size() == 81);
  for (std::size_t i = 0; i < 80; ++i) {
    double twice = 0;
    for (std::uint64_t k = offset[i]; k < offset[i + 1]; ++k) {
      const std::uint64_t next = k + 1 == offset[i + 1] ? offset[i] : k + 1;
      twice += v[2 * k] * v[2 * next + 1] - v[2 * k + 1] * v[2 * next];
    }
    CHECK(twice / 2 == doctest::Approx(diagram.mass()[i]).epsilon(1e-12));
  }
}

TEST_CASE("cells that degenerate to a corner or an edge of the outline have no vertices") {
  for (const double y : {1.5, 0.5}) {  // the bisector meets the square in (1, 1), or in its right edge
    ConvexDiagram diagram;
    diagram.set_outline(columns(square));
    const Columns seeds{{0.5, 1.5}, {0.5, y}};
    diagram.set_seeds(seeds, false);
    std::vector<std::uint64_t> offset;
    std::vector<double> vertices;
    diagram.compute_vertices(std::vector<double>{0, 0}, offset, vertices);
    CHECK(offset == std::vector<std::uint64_t>{0, 4, 4});
  }
}
