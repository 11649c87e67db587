// Cells of seeds in shards of periodic domains, with the diagram of all seeds as the oracle.
#include <doctest/doctest.h>

#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Moves seeds by whole periods of the domain, each by up to `most` of them.
void scatter_over_periods(SeedArray& seeds, const Domain& domain, int most, Random& random) {
  const auto periods = domain.periods();
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (const auto& period : periods) {
      const double times = static_cast<double>(random.index(2 * static_cast<std::size_t>(most) + 1)) - most;
      for (int k = 0; k < seeds.dimension; ++k)
        seeds.coordinate(i, k) += times * period[static_cast<std::size_t>(k)];
    }
}

Domain periodic_cube() {
  const std::array<double, 3> low{0, 0, 0}, high{1, 1, 1};
  return Domain::periodic_box(low, high);
}

}  // namespace

TEST_CASE("shards of periodic domains: boxes and lattices, seeds as given") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : periodic_domains()) {
    INFO(named.name);
    for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
      CAPTURE(name(range));
      SeedArray seeds = seeds_for(named.domain, Distribution::white, range, 400, random);
      Diagram diagram = diagram_of(named.domain, seeds);
      check_shares(diagram, along_curve(seeds, 4));
      check_shares(diagram, at_random(seeds, 3, random));
      scatter_over_periods(seeds, named.domain, 3, random);
      Diagram scattered = diagram_of(named.domain, seeds);
      check_shares(scattered, along_curve(seeds, 3));
    }
  }
}

TEST_CASE("shards of periodic domains: few seeds, whose cells are their own neighbours") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : periodic_domains()) {
    INFO(named.name);
    for (const std::size_t n : {1u, 2u, 3u, 9u}) {
      CAPTURE(n);
      const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, n, random);
      Diagram diagram = diagram_of(named.domain, seeds);
      check_shares(diagram, at_random(seeds, 3, random));
    }
  }
}

TEST_CASE("shards of periodic domains: lattices of seeds, where every vertex is a tie") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = grid(6, 3);
  Diagram diagram = diagram_of(periodic_cube(), seeds);
  check_shares(diagram, along_curve(seeds, 5));
  check_shares(diagram, at_random(seeds, 3, random));
  for (double& w : seeds.weights) w = -static_cast<double>(random.index(3)) / 36;  // some cells are flat
  Diagram weighted = diagram_of(periodic_cube(), seeds);
  check_shares(weighted, along_curve(seeds, 4));
  check_shares(weighted, at_random(seeds, 3, random));
}

TEST_CASE("shards of periodic domains: duplicates some periods apart, in different shards") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 200, 3, random);
  for (double& x : seeds.positions) x = std::ldexp(std::floor(std::ldexp(x, 20)), -20);
  for (std::size_t i = 0; i < 200; i += 3)
    seeds.push({seeds.coordinate(i, 0) + 2, seeds.coordinate(i, 1) - 1, seeds.coordinate(i, 2)},
               seeds.weights[i] + (static_cast<double>(random.index(3)) - 1) * 1e-4);
  Diagram diagram = diagram_of(periodic_cube(), seeds);
  REQUIRE(diagram.measures().count(SeedStatus::duplicate) > 50);
  check_shares(diagram, along_curve(seeds, 4));
  check_shares(diagram, at_random(seeds, 5, random));
}

TEST_CASE("shards of periodic domains: one seed far heavier than the others, and clusters") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const double heavy : {1e-3, 0.1, 1.0}) {
    CAPTURE(heavy);
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
    for (double& w : seeds.weights) w *= 1e-6;
    seeds.weights[77] = heavy;
    Diagram diagram = diagram_of(periodic_cube(), seeds);
    check_shares(diagram, along_curve(seeds, 4));
  }
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 600, 3, random);
  Diagram diagram = diagram_of(periodic_cube(), seeds);
  check_shares(diagram, along_curve(seeds, 5));
}

TEST_CASE("shards of periodic domains: a cluster whose outer cells reach around the domain") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 3000, 2, random);
  scale(seeds, 0.02);
  const std::array<double, 2> low{0, 0}, high{1, 1};
  Diagram diagram = diagram_of(Domain::periodic_box(low, high), seeds);
  check_shares(diagram, along_curve(seeds, 4));
  check_shares(diagram, at_random(seeds, 3, random));
}

TEST_CASE("shards of periodic domains: seeds given as far away as they may be") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
  for (std::size_t i = 0; i < seeds.size(); i += 2) seeds.coordinate(i, 1) += 0x1p27;
  Diagram diagram = diagram_of(periodic_cube(), seeds);
  check_shares(diagram, along_curve(seeds, 4));
  // Small cells that tie, whose vertices are rounded to a part of their size.
  SeedArray lattice = grid(100, 2);
  for (double& x : lattice.positions) x += 0x1p27;
  const std::array<double, 2> low{0, 0}, high{1, 1};
  Diagram far = diagram_of(Domain::periodic_box(low, high), lattice);
  check_shares(far, along_curve(lattice, 3));
}

TEST_CASE("shards of periodic domains: most cells of a large one are far from all others") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::array<double, 2> low{0, 0}, high{1, 1};
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 6000, 2, random);
  Diagram diagram = diagram_of(Domain::periodic_box(low, high), seeds);
  const exchange::ExchangeReport report = check_shares(diagram, along_curve(seeds, 3));
  CHECK(report.vertices < seeds.size());
  CHECK(static_cast<double>(report.fetched) < 2 * static_cast<double>(report.neighbors));
  CHECK(static_cast<double>(report.clipped) < 1.2 * static_cast<double>(seeds.size()));
}
