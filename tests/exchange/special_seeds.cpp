// Seeds in shards that tie, hide each other, or are at the same position.
#include <doctest/doctest.h>

#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("shards: lattices, where every vertex is a tie") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const SeedArray seeds = grid(dimension == 2 ? 16 : 8, dimension);
    Diagram diagram = diagram_of(unit_box(dimension), seeds);
    check_shares(diagram, along_curve(seeds, 5));
    check_shares(diagram, at_random(seeds, 3, random));
  }
}

TEST_CASE("shards: lattices in meshed domains, whose walls lie in facets") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : volume_domains()) {
    INFO(named.name);
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.low[k] = named.domain.low()[k];
      box.high[k] = named.domain.high()[k];
    }
    const SeedArray seeds = grid(5, 3, box);
    Diagram diagram = diagram_of(named.domain, seeds);
    check_shares(diagram, at_random(seeds, 3, random));
  }
}

TEST_CASE("shards: lattices with integer weights, of which some cells are flat") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (int round = 0; round < 3; ++round) {
      CAPTURE(dimension);
      CAPTURE(round);
      const int per_axis = dimension == 2 ? 16 : 8;  // so that no coordinate is rounded
      SeedArray seeds = grid(per_axis, dimension);
      const double step = 1.0 / per_axis;
      for (double& w : seeds.weights) w = -static_cast<double>(random.index(3)) * step * step;
      Diagram diagram = diagram_of(unit_box(dimension), seeds);
      check_shares(diagram, along_curve(seeds, 3));
      check_shares(diagram, at_random(seeds, 4, random));
    }
}

TEST_CASE("shards: a flat cell in a shard of its own") {
  // The cell of the middle seed is the plane between the others.
  SeedArray seeds{2, {}, {}};
  seeds.push({0.25, 0.5}, 0);
  seeds.push({0.5, 0.5}, -0.0625);
  seeds.push({0.75, 0.5}, 0);
  Diagram diagram = diagram_of(unit_box(2), seeds);
  REQUIRE(diagram.measures().status[1] == SeedStatus::hidden);
  REQUIRE(diagram.adjacency().neighbor == std::vector<std::uint32_t>{2, 0});
  for (const auto& shard : std::vector<std::vector<std::size_t>>{{0, 1, 2}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}})
    check_shares(diagram, {seeds, shard, 3});
}

TEST_CASE("shards: one seed of a million times the weight of the others") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const double heavy : {1e-3, 1.0, 1e6}) {
    CAPTURE(heavy);
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 500, 3, random);
    for (double& w : seeds.weights) w *= 1e-6;
    seeds.weights[77] = heavy;
    Diagram diagram = diagram_of(unit_box(3), seeds);
    check_shares(diagram, along_curve(seeds, 5));
    check_shares(diagram, at_random(seeds, 4, random));
  }
}

TEST_CASE("shards: a shard whose seeds are all hidden, and shards without seeds") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 300, 3, random);
  std::vector<std::size_t> shard(seeds.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    shard[i] = 1 + i % 3;
    if (shard[i] == 2) seeds.weights[i] = -10;
  }
  Diagram diagram = diagram_of(unit_box(3), seeds);
  check_shares(diagram, {seeds, shard, 6});
}

TEST_CASE("shards: more of them than seeds, and no seeds at all") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 5, 2, random);
  Diagram diagram = diagram_of(unit_box(2), seeds);
  check_shares(diagram, along_curve(seeds, 9));
  const SeedArray none{2, {}, {}};
  CHECK(exchange::compute_shards(test_device(), unit_box(2), Shares(none, {}, 3).view()).report.rounds == 0);
  CHECK(exchange::compute_shards(test_device(), unit_box(2), {}).shards.empty());
}

TEST_CASE("shards: duplicates in different shards") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
    SeedArray seeds = random_seeds(Distribution::white, range, 300, 3, random);
    const std::size_t count = seeds.size();
    for (std::size_t i = 0; i < count; i += 2) {
      const std::array<double, 3> at{seeds.coordinate(i, 0), seeds.coordinate(i, 1), seeds.coordinate(i, 2)};
      // As heavy, lighter and heavier, so that some of either are hidden beside.
      const double other = seeds.weights[i] + (static_cast<double>(random.index(3)) - 1) * 1e-3;
      seeds.push({at[0], at[1], at[2]}, other);
      if (i % 6 == 0) seeds.push({at[0], at[1], at[2]}, other);
    }
    Diagram diagram = diagram_of(unit_box(3), seeds);
    REQUIRE(diagram.measures().count(SeedStatus::duplicate) > 100);
    check_shares(diagram, along_curve(seeds, 4));
    check_shares(diagram, at_random(seeds, 5, random));
  }
}

TEST_CASE("shards: clusters over orders of magnitude, and far from the origin") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = spread_over_scales(500, 3, 9, random);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  check_shares(diagram, along_curve(seeds, 4));
  SeedArray far = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
  translate(far, {1e9, -1e9, 1e9});
  const std::array<double, 3> low{1e9, -1e9, 1e9}, high{1e9 + 1, -1e9 + 1, 1e9 + 1};
  Diagram far_diagram = diagram_of(Domain::box(low, high), far);
  check_shares(far_diagram, along_curve(far, 4));
}
