// Brute force against diagrams with closed forms.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/brute_force.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr double tiny = 1e-17;  // a few roundings of long double, for numbers about 1

bool near(Real a, Real b, double tolerance = tiny) {
  return std::abs(static_cast<double>(a - b)) <= tolerance;
}

SeedArray two_seeds(int dimension, double weight) {
  SeedArray seeds;
  seeds.dimension = dimension;
  seeds.positions = dimension == 2 ? std::vector<double>{0.25, 0.5, 0.75, 0.5}
                                   : std::vector<double>{0.25, 0.5, 0.5, 0.75, 0.5, 0.5};
  seeds.weights = {weight, 0};
  return seeds;
}

}  // namespace

TEST_CASE("brute force: two seeds share the unit box at the bisector") {
  for (const int d : {2, 3})
    for (const double w : {0.0, 0.125, -0.0625}) {
      CAPTURE(d);
      CAPTURE(w);
      const SeedArray seeds = two_seeds(d, w);
      const ReferenceDiagram r = brute_force(box_mesh(d), seeds.view());
      // |x - p0|^2 - w = |x - p1|^2 at x = 1/2 + w / (2 * 1/2).
      const Real x = 0.5L + static_cast<Real>(w);
      CHECK(near(r.mass[0], x));
      CHECK(near(r.mass[1], 1 - x));
      CHECK(near(r.first[0].x, x * (x / 2 - 0.25L)));
      CHECK(near(r.first[0].y, 0));
      // The integral of (t - 1/4)^2 over [0, x], and of (t - 1/2)^2 = 1/12 for each other axis.
      const auto cube = [](Real t) { return t * t * t; };
      CHECK(near(r.second_moment[0], (cube(x - 0.25L) + cube(0.25L)) / 3 + (d - 1) * x / 12));
      CHECK(near(r.wall.at({0, 1}), 1));
      CHECK(near(r.wall.at({1, 0}), 1));
      CHECK(r.simplices.empty());
    }
}

TEST_CASE("brute force: a regular grid gives equal boxes") {
  for (const int d : {2, 3}) {
    CAPTURE(d);
    const int m = 4;
    const SeedArray seeds = grid(m, d);
    const ReferenceDiagram r = brute_force(box_mesh(d), seeds.view());
    const Real h = 0.25L, cell = std::pow(h, d);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      CHECK(near(r.mass[i], cell));
      CHECK(near(r.second_moment[i], cell * d * h * h / 12));
      CHECK(r.status[i] == SeedStatus::ok);
    }
    Real walls = 0;
    for (const auto& entry : r.wall) walls += entry.second;
    CHECK(near(walls, 2 * d * (m - 1), 1e-15));  // m - 1 unit walls an axis, seen from both sides
  }
}

TEST_CASE("brute force: hexagonal and body-centred lattices") {
  SeedArray hexagonal{2, {}, {}};
  const double row = std::sqrt(0.75);
  for (int j = -3; j <= 3; ++j)
    for (int i = -3; i <= 3; ++i) hexagonal.push({i + 0.5 * (j & 1), j * row}, 0.3);
  const ReferenceDiagram hexagons = brute_force(box_mesh(2, {{-9, -9, 0}, {9, 9, 0}}), hexagonal.view());
  CHECK(near(hexagons.mass[24], std::sqrt(0.75L), 1e-15));  // row is a rounded double

  SeedArray body_centred{3, {}, {}};
  for (int k = -2; k <= 2; ++k)
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i) {
        body_centred.push({1.0 * i, 1.0 * j, 1.0 * k}, 0);
        body_centred.push({i + 0.5, j + 0.5, k + 0.5}, 0);
      }
  const std::uint32_t middle = 2 * 62;
  const ReferenceDiagram octahedra = brute_force(box_mesh(3, {{-9, -9, -9}, {9, 9, 9}}), body_centred.view());
  CHECK(near(octahedra.mass[middle], 0.5L));
  int squares = 0, hexagon_faces = 0;
  for (const auto& [pair, area] : octahedra.wall) {
    if (pair.first != middle || area < 1e-12L) continue;
    if (near(area, 0.125L)) ++squares;
    if (near(area, 3 * std::sqrt(3.0L) / 16)) ++hexagon_faces;  // edge sqrt(2)/4
  }
  CHECK(squares == 6);
  CHECK(hexagon_faces == 8);
}

TEST_CASE("brute force: of seeds at one position the heaviest has the cell, then the first") {
  for (const int d : {2, 3}) {
    SeedArray seeds;
    seeds.dimension = d;
    for (const double w : {0.1, 0.3, 0.3, -1.0}) {
      for (int k = 0; k < d; ++k) seeds.positions.push_back(0.5);
      seeds.weights.push_back(w);
    }
    const ReferenceDiagram r = brute_force(box_mesh(d), seeds.view());
    CHECK(near(r.mass[1], 1));
    CHECK(r.status[1] == SeedStatus::ok);
    for (const std::size_t i : {0, 2, 3}) CHECK(r.status[i] == SeedStatus::duplicate);
  }
}

TEST_CASE("brute force: a heavy seed hides the others") {
  SeedArray seeds = two_seeds(3, 2.0);
  const ReferenceDiagram r = brute_force(box_mesh(3), seeds.view());
  CHECK(near(r.mass[0], 1));
  CHECK(r.status[1] == SeedStatus::hidden);
  CHECK(r.wall.empty());
}

TEST_CASE("brute force: no seeds, one seed") {
  CHECK(brute_force(box_mesh(2), SeedsView{2, {}, {}}).mass.empty());
  SeedArray one{2, {3, 4}, {-5}};
  CHECK(near(brute_force(box_mesh(2), one.view()).mass[0], 1));
}

TEST_CASE("brute force: measures sum to the domain's, and walls are symmetric") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3}) {
    const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 100, d, random);
    const ReferenceDiagram r = brute_force(box_mesh(d), seeds.view());
    CHECK(near(r.total(), 1));
    for (const auto& [pair, measure] : r.wall) {
      const auto back = r.wall.find({pair.second, pair.first});
      if (measure > 1e-15L) REQUIRE(back != r.wall.end());
      if (back != r.wall.end()) CHECK(near(measure, back->second, 1e-15));
    }
  }
}
