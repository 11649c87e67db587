// Degenerate and hostile seeds that must give a correct diagram.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/diagram/check.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

SeedArray at_points(int dimension, std::vector<double> positions) {
  SeedArray seeds{dimension, std::move(positions), {}};
  seeds.weights.assign(seeds.size(), 0.0);
  return seeds;
}

/// Checks seeds of `make(dimension, box)` in the unit square, on a sphere, in a ball and in boxes.
template <class Make>
void on_every_kind(Make make, Position position = Position::degenerate) {
  INFO(replay_hint());
  const NamedDomain kinds[] = {{"square", Domain::polygon(unit_square())},
                               {"sphere", surface_of(icosphere(1))},
                               {"ball", volume_of(ball_tetrahedra(0))},
                               {"box2", unit_box(2)},
                               {"box3", unit_box(3)}};
  for (const NamedDomain& kind : kinds) {
    INFO(kind.name);
    const int d = kind.domain.dimension();
    check_everywhere(kind.domain, make(d, Box{kind.domain.low(), kind.domain.high()}), position);
  }
}

}  // namespace

TEST_CASE("no seeds: empty results and the domain's measure") {
  for (const Setup& setup : all_setups())
    for (const int d : {2, 3}) {
      Diagram diagram(setup.device, unit_box(d), setup.options);
      diagram.set_seeds(SeedsView{d, {}, {}});
      CHECK(diagram.measures().mass.empty());
      CHECK(diagram.measures().domain_measure == doctest::Approx(1));
      CHECK(diagram.adjacency().offset == std::vector<std::uint64_t>{0});
      CHECK(diagram.cells().cell_count() == 0);
      CHECK(diagram.dual().size() == 0);
    }
}

TEST_CASE("one seed has the whole domain, wherever it is") {
  for (const double x : {0.5, 0.0, 17.0})
    on_every_kind(
        [&](int d, const Box&) { return at_points(d, std::vector<double>(static_cast<std::size_t>(d), x)); });
}

TEST_CASE("two seeds, and fewer seeds than the initial number of neighbours") {
  for (const std::size_t n : {2, 3, 5, 13})
    on_every_kind(
        [&](int d, const Box& box) {
          Random random(test_seed() + n);
          return random_seeds(Distribution::white, WeightRange::W1, n, d, random, box);
        },
        Position::degenerate);
}

TEST_CASE("all seeds at one position: the heaviest, else the first, has the whole domain") {
  on_every_kind([](int d, const Box&) {
    SeedArray seeds = at_points(d, std::vector<double>(static_cast<std::size_t>(40 * d), 0.25));
    return seeds;
  });
  on_every_kind([](int d, const Box&) {
    SeedArray seeds = at_points(d, std::vector<double>(static_cast<std::size_t>(40 * d), 0.25));
    for (std::size_t i = 0; i < seeds.size(); ++i) seeds.weights[i] = static_cast<double>(i * 7 % 40);
    return seeds;
  });
}

TEST_CASE("duplicates with different weights among other seeds") {
  on_every_kind([](int d, const Box& box) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 60, d, random, box);
    for (std::size_t i = 0; i < 30; ++i)
      for (int k = 0; k < d; ++k) seeds.coordinate(i, k) = seeds.coordinate(30 + i % 7, k);
    return seeds;
  });
}

TEST_CASE("grids: many seeds on one circle or sphere") {
  on_every_kind([](int d, const Box& box) { return grid(d == 2 ? 9 : 5, d, box); });
}

TEST_CASE("tilted grids") {
  on_every_kind([](int d, const Box& box) {
    SeedArray seeds = grid(d == 2 ? 9 : 5, d, box);
    rotate(seeds, 0.7, {0.5, 0.5, 0.5});
    return seeds;
  });
}

TEST_CASE("a grid whose walls lie in the facets between regions") {
  Random random(1);
  check_everywhere(volume_of(cube_tetrahedra(2, 0, random)), grid(4, 3), Position::degenerate);
  check_everywhere(surface_of(wavy_patch(4)), grid(4, 3), Position::degenerate);
  // The bisectors x = 1/4 and x = 3/4 partly lie in the boundary of a U, where there is no wall.
  const Ring u{{0, 0}, {1, 0}, {1, 1}, {0.75, 1}, {0.75, 0.25}, {0.25, 0.25}, {0.25, 1}, {0, 1}};
  check_everywhere(Domain::polygon(Parts{{u, {}}}),
                   at_points(2, {0.125, 0.5, 0.375, 0.5, 0.625, 0.125, 0.875, 0.125, 0.125, 0.125}),
                   Position::degenerate);
}

TEST_CASE("collinear seeds") {
  on_every_kind([](int d, const Box& box) { return collinear(50, d, box); });
  on_every_kind([](int d, const Box& box) {
    SeedArray seeds = collinear(50, d, box);
    for (std::size_t i = 0; i < seeds.size(); ++i)
      for (int k = 1; k < d; ++k) seeds.coordinate(i, k) = 0.125;
    return seeds;
  });
}

TEST_CASE("coplanar seeds") {
  Random random(test_seed());
  const SeedArray seeds = coplanar(70, random);
  check_everywhere(unit_box(3), seeds, Position::degenerate);
  check_everywhere(volume_of(ball_tetrahedra(0)), seeds, Position::degenerate);
  check_everywhere(surface_of(icosphere(1)), seeds, Position::degenerate);
}

TEST_CASE("cospherical seeds: all cells meet in one point") {
  on_every_kind([](int d, const Box& box) { return cospherical(40, d, box); });
}

TEST_CASE("seeds on vertices, edges and faces of the domain, and outside") {
  const std::vector<double> steps{-0.5, 0, 0.5, 1, 1.5};
  SeedArray plane{2, {}, {}}, space{3, {}, {}};
  for (const double x : steps)
    for (const double y : steps) {
      plane.push({x, y}, 0);
      for (const double z : steps) space.push({x, y, z}, 0);
    }
  check_everywhere(unit_box(2), plane, Position::degenerate);
  check_everywhere(Domain::polygon(square_with_holes()), plane, Position::degenerate);
  check_everywhere(unit_box(3), space, Position::degenerate);
  const Mesh sphere = icosphere(1);
  check_everywhere(surface_of(sphere), at_points(3, sphere.vertices), Position::degenerate);
  check_everywhere(volume_of(ball_tetrahedra(0)), at_points(3, icosphere(0).vertices), Position::degenerate);
}

TEST_CASE("seeds far outside the domain") {
  on_every_kind([](int d, const Box& box) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 30, d, random, box);
    for (std::size_t i = 0; i < 10; ++i)
      for (int k = 0; k < d; ++k) seeds.coordinate(i, k) *= 1e3;
    return seeds;
  });
  on_every_kind([](int d, const Box& box) {  // all of them on one side
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 30, d, random, box);
    translate(seeds, {50, 20, 10});
    return seeds;
  });
}

TEST_CASE("weights that hide all but one") {
  on_every_kind([](int d, const Box& box) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 80, d, random, box);
    seeds.weights[33] = 100;
    return seeds;
  });
}

TEST_CASE("one weight a million times the others") {
  on_every_kind([](int d, const Box& box) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 80, d, random, box);
    const double largest = *std::max_element(seeds.weights.begin(), seeds.weights.end());
    for (double& w : seeds.weights) w *= 1e-6 / largest;
    seeds.weights[5] = 1;
    // Far enough away that the heavy seed leaves a part of the domain to the others.
    for (int k = 0; k < d; ++k) seeds.coordinate(5, k) = box.low[0] - 0.3;
    return seeds;
  });
}

TEST_CASE("weights of any sign, shifted by a large constant") {
  for (const double shift : {-3.0, 1e6, -1e9})
    on_every_kind([&](int d, const Box& box) {
      Random random(test_seed());
      SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 60, d, random, box);
      for (double& w : seeds.weights) w += shift;
      return seeds;
    });
}

TEST_CASE("clusters over six orders of magnitude") {
  on_every_kind([](int d, const Box& box) {
    Random random(test_seed());
    return spread_over_scales(80, d, 6, random, box);
  });
}

TEST_CASE("cells of more than 64 and more than 255 faces") {
  for (const std::size_t around : {100, 300})
    for (const int d : {2, 3}) {
      INFO(around << " faces, " << d << "D");
      SeedArray seeds = cospherical(around, d);
      for (int k = 0; k < d; ++k) seeds.positions.push_back(0.5);
      seeds.weights.push_back(0.01);
      check_everywhere(unit_box(d), seeds, Position::degenerate);
    }
}

TEST_CASE("long thin cells") {
  for (const Setup& setup : all_setups())
    for (const int d : {2, 3}) {
      INFO(d << "D");
      // As thin as the precision can distinguish; thinner cells would coincide.
      const double squeeze = setup.options.precision == Precision::float32 ? 1e-2 : 1e-6;
      SeedArray seeds = grid(d == 2 ? 8 : 4, d);
      for (std::size_t i = 0; i < seeds.size(); ++i)
        seeds.coordinate(i, 0) = 0.5 + squeeze * (seeds.coordinate(i, 0) - 0.5);
      check_diagram(setup, unit_box(d), seeds, brute_force(unit_box(d).mesh(), seeds.view()),
                    Position::degenerate);
    }
}
