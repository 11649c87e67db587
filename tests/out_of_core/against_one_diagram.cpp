// Cells computed piece after piece, with the diagram of all seeds as the oracle.
#include <doctest/doctest.h>

#include "tests/out_of_core/compute.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("out of core: random seeds") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::cluster})
      for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
        INFO(dimension << "D " << name(distribution) << " " << name(range));
        const SeedArray seeds = random_seeds(distribution, range, 1000, dimension, random);
        Diagram diagram = diagram_of(unit_box(dimension), seeds);
        CHECK(check_pieces(diagram, seeds, 300).pieces > 3);
      }
}

TEST_CASE("out of core: any size of pieces") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  for (const std::uint64_t piece : {1, 9, 100, 299, 300, 1000}) {
    CAPTURE(piece);
    const OutOfCoreReport report = check_pieces(diagram, seeds, piece);
    CHECK(report.pieces * piece >= seeds.size());
    CHECK((report.fetched == 0) == (piece >= seeds.size()));
  }
}

TEST_CASE("out of core: no seeds, and one") {
  for (const std::size_t count : {0, 1}) {
    SeedArray seeds{2, {}, {}};
    if (count > 0) seeds.push({0.3, 0.4}, 1);
    Diagram diagram = diagram_of(unit_box(2), seeds);
    CHECK(check_pieces(diagram, seeds, 10).pieces == count);
  }
}

TEST_CASE(
    "out of core: more files than are written at a time, and clusters that share a place on the curve") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 400, 3, random);
  // 300 seeds in a cell of the grid of the curve, and 200 at one position.
  for (int k = 0; k < 300; ++k)
    seeds.push({0.5 + 1e-9 * random.uniform(), 0.5 + 1e-9 * random.uniform(), 0.5 + 1e-9 * random.uniform()},
               1e-20 * random.uniform());
  for (int k = 0; k < 200; ++k) seeds.push({0.25, 0.25, 0.75}, static_cast<double>(k % 7) * 1e-4);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  CHECK(diagram.measures().count(SeedStatus::duplicate) == 199);
  check_pieces(diagram, seeds, 3);
  check_pieces(diagram, seeds, 150);
}

TEST_CASE("out of core: all at one position, more than a piece has") {
  SeedArray seeds{3, {}, {}};
  for (int k = 0; k < 50; ++k) seeds.push({0.25, 0.5, 0.75}, k % 5);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  CHECK(check_pieces(diagram, seeds, 10).pieces == 1);
}

TEST_CASE("out of core: polygons and volumes of many regions") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : std::vector<NamedDomain>{{"islands", Domain::polygon(islands())},
                                                           {"letter", Domain::polygon(letter_u())},
                                                           {"ball", volume_of(ball_tetrahedra(0))}}) {
    INFO(named.name);
    const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W2, 400, random);
    Diagram diagram = diagram_of(named.domain, seeds);
    check_pieces(diagram, seeds, 120);
  }
}

TEST_CASE("out of core: periodic boxes and lattices, and seeds given some periods outside") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : periodic_domains()) {
    INFO(named.name);
    SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W2, 300, random);
    const auto period = named.domain.periods();
    for (std::size_t i = 0; i < seeds.size(); i += 3)
      for (int k = 0; k < seeds.dimension; ++k)
        seeds.coordinate(i, k) += 2 * period[0][static_cast<std::size_t>(k)];
    for (int k = 0; k < 60; ++k) {  // more than a piece has at one position
      if (seeds.dimension == 3)
        seeds.push({0.25, 0.5, 0.25}, 0);
      else
        seeds.push({0.25, 0.5}, 0);
    }
    Diagram diagram = diagram_of(named.domain, seeds);
    check_pieces(diagram, seeds, 50);
  }
}

TEST_CASE("out of core: flat cells of other pieces") {
  INFO(replay_hint());
  Random random(test_seed());
  std::uint64_t again = 0;
  for (const int dimension : {2, 3})
    for (int round = 0; round < 3; ++round) {
      CAPTURE(dimension);
      CAPTURE(round);
      const int per_axis = dimension == 2 ? 16 : 8;  // so that no coordinate is rounded
      SeedArray seeds = grid(per_axis, dimension);
      const double step = 1.0 / per_axis;
      for (double& w : seeds.weights) w = -static_cast<double>(random.index(3)) * step * step;
      Diagram diagram = diagram_of(unit_box(dimension), seeds);
      again += check_pieces(diagram, seeds, 40).again;
    }
  CHECK(again > 0);
}

TEST_CASE("out of core: some seeds of up to a million times the weight of the others") {
  INFO(replay_hint());
  Random random(test_seed());
  // At most 32 are sent to all pieces.
  for (const std::size_t count : {1u, 32u, 33u})
    for (const double heavy : {1e-3, 1.0, 1e6}) {
      CAPTURE(count);
      CAPTURE(heavy);
      SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 400, 3, random);
      for (double& w : seeds.weights) w *= 1e-6;
      for (std::size_t k = 0; k < count; ++k) seeds.weights[7 + 11 * k] = heavy;
      Diagram diagram = diagram_of(unit_box(3), seeds);
      check_pieces(diagram, seeds, 100);
    }
}
