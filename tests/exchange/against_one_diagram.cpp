// Cells of seeds in shards, with the diagram of all seeds as the oracle.
#include <doctest/doctest.h>

#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("shards: random seeds, along a curve and shared out at random") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
      for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
        INFO(dimension << "D " << name(distribution) << " " << name(range));
        const SeedArray seeds = random_seeds(distribution, range, 1200, dimension, random);
        Diagram diagram = diagram_of(unit_box(dimension), seeds);
        check_shares(diagram, along_curve(seeds, 6));
        check_shares(diagram, at_random(seeds, 3, random));
      }
}

TEST_CASE("shards: any number of them") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 400, 3, random);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  for (const std::size_t count : {1, 2, 7, 40}) {
    CAPTURE(count);
    const exchange::ExchangeReport report = check_shares(diagram, along_curve(seeds, count));
    CHECK((report.fetched == 0) == (count == 1));
  }
}

TEST_CASE("shards: most cells of a large one are far from all others") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
    const SeedArray seeds = random_seeds(distribution, WeightRange::W2, 6000, 2, random);
    Diagram diagram = diagram_of(unit_box(2), seeds);
    const exchange::ExchangeReport report = check_shares(diagram, along_curve(seeds, 3));
    CHECK(report.vertices < seeds.size());
  }
  const NamedDomain named{"islands", Domain::polygon(islands())};
  const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, 2500, random);
  Diagram diagram = diagram_of(named.domain, seeds);
  check_shares(diagram, along_curve(seeds, 2));
}

TEST_CASE("shards: polygons and volumes of many regions") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : std::vector<NamedDomain>{{"islands", Domain::polygon(islands())},
                                                           {"letter", Domain::polygon(letter_u())},
                                                           {"ball", volume_of(ball_tetrahedra(0))}}) {
    INFO(named.name);
    for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
      const SeedArray seeds = seeds_for(named.domain, Distribution::white, range, 500, random);
      Diagram diagram = diagram_of(named.domain, seeds);
      check_shares(diagram, along_curve(seeds, 4));
      check_shares(diagram, at_random(seeds, 2, random));
    }
  }
}

TEST_CASE("shards: few seeds are fetched that have no wall") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 6000, 3, random);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  const exchange::ExchangeReport report = check_shares(diagram, along_curve(seeds, 8));
  CHECK(static_cast<double>(report.fetched) < 1.6 * static_cast<double>(report.neighbors));
  CHECK(static_cast<double>(report.clipped) < 1.2 * static_cast<double>(seeds.size()));
  CHECK(report.rounds < 8);
}
