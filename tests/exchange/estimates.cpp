// What shards send each other before they clip: a estimate, which may be wrong, and a coarse tree of the
// rest, which may not.
#include <doctest/doctest.h>

#include <set>

#include "lib/exchange/tree_walk.hpp"
#include "lib/exchange/unsent.hpp"
#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;
using exchange::BoundaryLeaves;
using exchange::Estimate;
using exchange::Halo;
using exchange::OwnSeeds;
using exchange::Shard;

namespace {

constexpr std::size_t per_leaf = PackedTree::fan;

std::map<int, BoundaryLeaves> no_estimate(const Shard&) {
  return {};
}

/// The seeds of `leaves` leaves at random, for each other of `count` shards.
Estimate random_estimate(Random& random, int count, std::size_t leaves, double spacing) {
  return [&random, count, leaves, spacing](const Shard& shard) {
    std::map<int, BoundaryLeaves> boundaries;
    for (int other = 0; other < count; ++other) {
      if (other == shard.number() || shard.own().size() == 0) continue;
      BoundaryLeaves& boundary = boundaries[other];
      boundary.all = 1000;
      const auto d = static_cast<std::ptrdiff_t>(shard.own().tree().dimension);
      for (std::size_t k = 0; k < leaves; ++k) {
        boundary.spacing.push_back(spacing);
        for (std::size_t a = 0; a < per_leaf; ++a) {
          const double* const row = shard.own().row(random.index(shard.own().size()));
          boundary.seed.insert(boundary.seed.end(), row, row + d);
        }
      }
    }
    return boundaries;
  };
}

OwnSeeds own_of(const SeedArray& seeds) {
  std::vector<std::uint64_t> ids(seeds.size());
  std::iota(ids.begin(), ids.end(), std::uint64_t{0});
  return {ids, seeds.view(), seeds.dimension, 1};
}

/// One leaf of a boundary with seeds at random in the box from `low` to `high`.
BoundaryLeaves boundary_in(double low, double high, int dimension, Random& random) {
  BoundaryLeaves boundary{{0.05}, {}, 1000};
  for (std::size_t k = 0; k < per_leaf * static_cast<std::size_t>(dimension); ++k)
    boundary.seed.push_back(random.uniform(low, high));
  return boundary;
}

}  // namespace

TEST_CASE("estimates: cells do not depend on what is estimated") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
    const WeightRange range = distribution == Distribution::white ? WeightRange::W2 : WeightRange::W0;
    INFO(name(distribution) << " " << name(range));
    SeedArray seeds = random_seeds(distribution, range, 900, 3, random);
    seeds.weights[77] += 0.1;  // reaches into all shards, whatever positions say
    for (std::size_t i = 0; i < 100; ++i)
      seeds.push({seeds.coordinate(i, 0), seeds.coordinate(i, 1), seeds.coordinate(i, 2)}, 0);
    Diagram diagram = diagram_of(unit_box(3), seeds);
    const Shares shares = along_curve(seeds, 4);
    check_shares(diagram, shares);
    check_shares(diagram, shares, no_estimate);
    check_shares(diagram, shares, random_estimate(random, 4, 3, 0.1));
    check_shares(diagram, shares, random_estimate(random, 4, 40, 10));  // nearly all is sent
  }
}

TEST_CASE("estimates: flat cells and ties of seeds that were sent before anyone clipped") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const int per_axis = dimension == 2 ? 16 : 8;
    SeedArray seeds = grid(per_axis, dimension);
    for (double& w : seeds.weights) w = -static_cast<double>(random.index(3)) / (per_axis * per_axis);
    Diagram diagram = diagram_of(unit_box(dimension), seeds);
    check_shares(diagram, along_curve(seeds, 3));
    check_shares(diagram, at_random(seeds, 3, random), random_estimate(random, 3, 10, 1));
  }
}

TEST_CASE("estimates: large shards need few rounds and clip few cells twice") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Distribution distribution : {Distribution::blue, Distribution::cluster}) {
    INFO(name(distribution));
    const SeedArray seeds = random_seeds(distribution, WeightRange::W0, 5000, 3, random);
    Diagram diagram = diagram_of(unit_box(3), seeds);
    const exchange::ExchangeReport report = check_shares(diagram, along_curve(seeds, 2));
    CHECK(static_cast<double>(report.clipped) < 1.3 * static_cast<double>(seeds.size()));
    CHECK(static_cast<double>(report.fetched) < 2.0 * static_cast<double>(report.neighbors));
  }
}

TEST_CASE("estimates: seeds that a shard's own ones hide are set aside and not sent") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 3000, dimension, random);
    Diagram diagram = diagram_of(unit_box(dimension), seeds);
    const Diagram::State state(test_device(), unit_box(dimension), {});
    OwnSeeds own = own_of(seeds);
    own.set_hidden_aside(state.setup);
    std::size_t aside = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      if (!own.is_hidden(i)) continue;
      ++aside;
      CHECK(diagram.measures().status[i] == SeedStatus::hidden);
    }
    CHECK(2 * aside > diagram.measures().count(SeedStatus::hidden));
    CHECK(own.in_tree().size() == seeds.size() - aside);
    const Halo halo = own.near(1, boundary_in(0.3, 0.7, dimension, random));
    CHECK(halo.id.size() > 5);
    for (const std::uint64_t id : halo.id) CHECK(!own.is_hidden(id));
  }
}

TEST_CASE(
    "estimates: cells, and duplicates of hidden seeds, in large shards of which many seeds are hidden") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 4500, 3, random);
  for (std::size_t i = 0; i < 500; ++i)  // lighter, as heavy or heavier than another one
    seeds.push({seeds.coordinate(i, 0), seeds.coordinate(i, 1), seeds.coordinate(i, 2)},
               seeds.weights[i] + (static_cast<double>(random.index(3)) - 1) * 1e-4);
  Diagram diagram = diagram_of(unit_box(3), seeds);
  REQUIRE(diagram.measures().count(SeedStatus::duplicate) == 500);
  const exchange::ExchangeReport report = check_shares(diagram, along_curve(seeds, 2));
  CHECK(report.clipped < seeds.size());
  check_shares(diagram, at_random(seeds, 2, random));
}

TEST_CASE("estimates: the coarse tree of the rest has every seed that was not sent") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const std::size_t count : {std::size_t{3}, std::size_t{3000}}) {
      INFO(dimension << "D " << count);
      const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, count, dimension, random);
      OwnSeeds own = own_of(seeds);
      const Halo halo = own.near(1, boundary_in(0.4, 0.6, dimension, random));
      const std::set<std::uint64_t> sent(halo.id.begin(), halo.id.end());
      CHECK(sent.size() == halo.id.size());
      CHECK((count < 10 || !sent.empty()));
      REQUIRE(halo.seed.size() == sent.size() * (static_cast<std::size_t>(dimension) + 1));
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (sent.contains(i)) continue;
        CAPTURE(i);
        const double* const row = own.row(i);
        CHECK(exchange::has_open_leaf(halo.unsent, [&](std::uint32_t node) {
          return exchange::contains(halo.unsent, node, row) && halo.unsent.weight[node] >= row[dimension];
        }));
      }
    }
}

TEST_CASE("estimates: when all seeds were sent nothing is left") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 100, 3, random);
  OwnSeeds own = own_of(seeds);
  BoundaryLeaves all{{}, {}, 1000};
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    all.spacing.push_back(100);
    for (std::size_t a = 0; a < per_leaf; ++a) all.seed.insert(all.seed.end(), own.row(i), own.row(i) + 3);
  }
  const Halo halo = own.near(1, all);
  CHECK(halo.id.size() == seeds.size());
  CHECK(halo.unsent.levels() == 0);
  const double row[] = {0.5, 0.5, 0.5, 0};
  exchange::CutTest test(row, 10, 3);
  CHECK(!exchange::may_cut(halo.unsent, test));
}

TEST_CASE("estimates: seeds in a boundary are asked about near another shard, and not if the two are mixed") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 4000, 2, random);
  const Shares halves = along_curve(seeds, 2), mixed = at_random(seeds, 2, random);
  const auto near_between = [](const Shares& shares) {
    const std::vector<exchange::ShardSeeds> view = shares.view();
    const OwnSeeds one(view[0].ids, view[0].seeds, 2, 1);
    OwnSeeds other(view[1].ids, view[1].seeds, 2, 1);
    const BoundaryLeaves boundary =
        one.boundary(exchange::coarse_tree_of(other.tree(), 512), exchange::translations(nullptr));
    CHECK(boundary.seed.size() == boundary.leaves() * per_leaf * 2);
    CHECK(boundary.leaves() <= boundary.all);
    const Halo halo = other.near(0, boundary);
    if (halo.id.empty()) {
      const exchange::NearPart part{
          exchange::box_around(boundary.seed.data(), boundary.leaves() * per_leaf, 2), boundary.lightest};
      CHECK(halo.unsent.low ==
            exchange::coarse_tree_of(other.tree(), exchange::cut_near(other.tree(), 0, part)).low);
    }
    return std::pair(boundary.leaves(), halo.id.size());
  };
  const auto [leaves, sent] = near_between(halves);
  CHECK(leaves > 5);
  CHECK(leaves * per_leaf < seeds.size() / 4);
  CHECK(sent > 20);
  CHECK(sent < seeds.size() / 8);
  CHECK(near_between(mixed).second == 0);
}
