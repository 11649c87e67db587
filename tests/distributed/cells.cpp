// Cells of seeds on ranks that are threads, with the diagram of all seeds as the oracle.
#include <doctest/doctest.h>

#include "lib/base/rank_mailbox.hpp"
#include "lib/exchange/redistribution.hpp"
#include "tests/distributed/ranks.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("ranks: any number of them has the cells of one diagram") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::cluster})
      for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
        INFO(dimension << "D " << name(distribution) << " " << name(range));
        const SeedArray seeds = random_seeds(distribution, range, 600, dimension, random);
        Diagram diagram = diagram_of(unit_box(dimension), seeds);
        for (const std::size_t count : {1, 2, 3, 5}) {
          CAPTURE(count);
          check_ranks(diagram, along_curve(seeds, count));
          check_ranks(diagram, at_random(seeds, count, random), {{}, true});
        }
      }
}

TEST_CASE("ranks: they send what shards in one process do") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 1000, 3, random);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  const Shares shares = along_curve(seeds, 4);
  const ExchangeReport ranks = check_ranks(diagram, shares), shards = check_shares(diagram, shares);
  CHECK(ranks.rounds == shards.rounds);
  CHECK(ranks.fetched == shards.fetched);
  CHECK(ranks.neighbors == shards.neighbors);
  CHECK(ranks.clipped == shards.clipped);
  CHECK(ranks.vertices == shards.vertices);
  CHECK(ranks.outlines == shards.outlines);
  CHECK(ranks.requests == shards.requests);
  CHECK(ranks.replies == shards.replies);
  CHECK(ranks.ending == shards.ending);
  CHECK(ranks.redistributed == 0);
}

TEST_CASE("ranks: polygons, volumes, duplicates and flat cells") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : std::vector<NamedDomain>{{"islands", Domain::polygon(islands())},
                                                           {"ball", volume_of(ball_tetrahedra(0))}}) {
    INFO(named.name);
    SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W2, 300, random);
    for (std::size_t i = 0; i < 40; ++i) {
      const double z = seeds.dimension == 3 ? seeds.coordinate(i, 2) : 0;
      if (seeds.dimension == 3)
        seeds.push({seeds.coordinate(i, 0), seeds.coordinate(i, 1), z}, seeds.weights[i]);
      else
        seeds.push({seeds.coordinate(i, 0), seeds.coordinate(i, 1)}, seeds.weights[i]);
    }
    Diagram diagram = diagram_of(named.domain, seeds);
    REQUIRE(diagram.measures().count(SeedStatus::duplicate) == 40);
    check_ranks(diagram, at_random(seeds, 3, random));
    check_ranks(diagram, at_random(seeds, 3, random), {{}, true});
  }
  const SeedArray lattice = grid(12, 2);
  Diagram diagram = diagram_of(unit_box(2), lattice);
  check_ranks(diagram, at_random(lattice, 3, random));
}

TEST_CASE("ranks: periodic boxes and lattices, where walls have shifts") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : periodic_domains()) {
    INFO(named.name);
    const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, 300, random);
    Diagram diagram = diagram_of(named.domain, seeds);
    check_ranks(diagram, along_curve(seeds, 3));
    check_ranks(diagram, at_random(seeds, 3, random), {{}, true});
  }
}

TEST_CASE("ranks: without seeds, more of them than seeds, and no seeds at all") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
  std::vector<std::size_t> rank(seeds.size());
  for (std::size_t i = 0; i < rank.size(); ++i) rank[i] = 1 + 2 * (i % 2);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  const SeedArray few = random_seeds(Distribution::white, WeightRange::W1, 3, 2, random);
  Diagram small = diagram_of(unit_box(2), few);
  for (const bool redistribute : {false, true}) {
    CAPTURE(redistribute);
    check_ranks(diagram, {seeds, rank, 5}, {{}, redistribute});
    check_ranks(small, {few, {4, 0, 4}, 6}, {{}, redistribute});
    const SeedArray none{2, {}, {}};
    for (const DistributedCells& cells : on_ranks(unit_box(2), Shares(none, {}, 3), {{}, redistribute})) {
      CHECK(cells.offset == std::vector<std::uint64_t>{0});
      CHECK(cells.report.rounds == 0);
      CHECK(cells.measures.domain_measure == 1);
    }
  }
}

TEST_CASE("ranks: ids of any size in any order, and seeds without weights") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 200, 2, random);
  Diagram diagram = diagram_of(unit_box(2), seeds);
  const auto id = [](std::uint64_t i) { return ~std::uint64_t{0} - 7 * i; };
  std::vector<DistributedCells> cells(2);
  for (const std::exception_ptr& thrown : on_ranks(2, [&](Communicator& communicator) {
         const auto rank = static_cast<std::size_t>(communicator.rank());
         std::vector<std::uint64_t> ids;
         for (std::size_t k = 0; k < 100; ++k) ids.push_back(id(100 * rank + k));
         const auto positions = std::span(seeds.positions).subspan(200 * rank, 200);
         cells[rank] = compute_distributed(communicator, test_device(), unit_box(2), ids, {2, positions, {}});
       }))
    REQUIRE(!thrown);
  const Adjacency& adjacency = diagram.adjacency();
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const DistributedCells& own = cells[i / 100];
    std::vector<std::uint64_t> expected;
    for (std::uint64_t k = adjacency.offset[i + 1]; k > adjacency.offset[i]; --k)
      expected.push_back(id(adjacency.neighbor[k - 1]));
    const auto row = own.neighbor.begin();
    CHECK(expected == std::vector(row + static_cast<std::ptrdiff_t>(own.offset[i % 100]),
                                  row + static_cast<std::ptrdiff_t>(own.offset[i % 100 + 1])));
  }
}

TEST_CASE("ranks: redistribution fetches less than seeds shared out at random, and shares them out evenly") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W0, 2000, 3, random);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  const Shares shares = at_random(seeds, 4, random);
  CHECK(2 * check_ranks(diagram, shares, {{}, true}).fetched < check_ranks(diagram, shares).fetched);

  // All seeds but one in one cell of the curve's grid, and most on one rank.
  SeedArray dense = random_seeds(Distribution::white, WeightRange::W0, 1000, 3, random);
  scale(dense, 1e-9);
  dense.push({1, 1, 1}, 0);
  std::vector<std::size_t> rank(dense.size(), 2);
  rank[3] = 0;
  for (const Shares& given : {at_random(seeds, 5, random), Shares(dense, rank, 5)}) {
    const std::vector<exchange::ShardSeeds> view = given.view();
    std::vector<std::size_t> sizes(5);
    for (const std::exception_ptr& thrown : on_ranks(5, [&](Communicator& communicator) {
           RankMailbox mailbox(communicator);
           const auto own = static_cast<std::size_t>(communicator.rank());
           sizes[own] = exchange::Redistribution(view[own], 3, 1, mailbox).seeds().ids.size();
         }))
      REQUIRE(!thrown);
    const double share = std::accumulate(sizes.begin(), sizes.end(), 0.0) / 5;
    CHECK(share >= 200);
    for (const std::size_t size : sizes) CHECK(std::abs(static_cast<double>(size) - share) < 0.1 * share);
  }
}
