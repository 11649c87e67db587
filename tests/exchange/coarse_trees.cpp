// What shards know of each other: a box of each, and coarse trees of those near them.
#include <doctest/doctest.h>

#include <set>

#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;
using exchange::CutTest;
using exchange::FirstCoarseTrees;
using exchange::NearPart;
using exchange::OwnSeeds;
using exchange::Shard;

namespace {

/// The seeds of one shard, with ids from 0.
OwnSeeds all_own(const SeedArray& seeds) {
  std::vector<std::uint64_t> ids(seeds.size());
  std::iota(ids.begin(), ids.end(), std::uint64_t{0});
  return {ids, seeds.view(), seeds.dimension, 1};
}

/// Shards by slabs of x.
Shares in_slabs(const SeedArray& seeds, std::size_t count) {
  std::vector<std::size_t> shard;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    shard.push_back(
        std::min(count - 1, static_cast<std::size_t>(seeds.coordinate(i, 0) * static_cast<double>(count))));
  return {seeds, shard, count};
}

/// Shards that know the boxes of all.
std::vector<Shard> shards_that_met(const Shares& shares) {
  std::vector<Shard> shards;
  std::vector<PackedTree> boxes;
  for (const exchange::ShardSeeds& view : shares.view()) {
    shards.emplace_back(static_cast<int>(shards.size()), view.ids, view.seeds, shares.dimension, 1);
    boxes.push_back(exchange::coarse_tree_of(shards.back().own().tree(), 1));
  }
  const auto first = std::make_shared<FirstCoarseTrees>(std::move(boxes), shares.dimension);
  for (Shard& shard : shards) shard.meet(first);
  return shards;
}

std::set<int> asked_by(const Shard& shard) {
  std::set<int> numbers;
  for (const auto& [number, part] : shard.near_parts()) numbers.insert(number);
  return numbers;
}

}  // namespace

TEST_CASE(
    "coarse trees: one that is fine near a part has every seed, and the part's surroundings leaf by leaf") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
      INFO(dimension << "D " << name(distribution));
      SeedArray seeds = random_seeds(distribution, WeightRange::W1, 3000, dimension, random);
      seeds.weights[random.index(seeds.size())] += 0.04;  // reaches 0.2 farther than others
      OwnSeeds own = all_own(seeds);
      NearPart part{
          exchange::box_around(own.row(random.index(seeds.size())), 1, static_cast<std::size_t>(dimension)),
          *std::min_element(seeds.weights.begin(), seeds.weights.end())};
      const exchange::TreeCut cut = exchange::cut_near(own.tree(), 0, part);
      const PackedTree coarse_tree = own.coarse_tree(1, part);
      CHECK(coarse_tree.seeds == cut.size());
      CHECK(cut.size() < own.tree().level_offset[1]);
      std::size_t next = 0;  // of the ranks
      for (const exchange::TreeNode& node : cut) {
        const std::pair<std::size_t, std::size_t> ranks =
            own.in_tree().ranks_of(own.tree().level_offset[node.level] + node.node);
        REQUIRE(ranks.first == next);
        next = ranks.second;
      }
      CHECK(next == seeds.size());
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        const double* const row = own.row(i);
        CHECK(exchange::has_open_leaf(coarse_tree, [&](std::uint32_t number) {
          return exchange::contains(coarse_tree, number, row) && coarse_tree.weight[number] >= row[dimension];
        }));
      }
      for (const exchange::TreeNode& node : cut) {
        if (node.level == 0) continue;
        const std::uint32_t number = own.tree().level_offset[node.level] + node.node;
        const double away = std::sqrt(exchange::gap2(exchange::box_of(own.tree(), number), part.box.view(),
                                                     static_cast<std::size_t>(dimension)));
        CHECK(away * away > own.tree().weight[number] - part.lightest);
        CHECK(away > 0);
      }
    }
}

TEST_CASE("coarse trees: shards are found by their boxes as if all were looked at") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 2000, 3, random);
  Shares shares = at_random(seeds, 40, random);
  for (const std::size_t empty : {std::size_t{0}, std::size_t{13}, std::size_t{39}}) {
    shares.ids[empty].clear();
    shares.positions[empty].clear();
    shares.weights[empty].clear();
  }
  const std::vector<Shard> shards = shards_that_met(along_curve(seeds, 40)), mixed = shards_that_met(shares);
  for (const std::vector<Shard>* const all : {&shards, &mixed}) {
    std::vector<PackedTree> boxes;
    for (const Shard& shard : *all) boxes.push_back(exchange::coarse_tree_of(shard.own().tree(), 1));
    exchange::OtherShards others(7);
    others.meet(std::make_shared<FirstCoarseTrees>(boxes, 3));
    const std::vector<exchange::Point> moves(1);
    exchange::NearBoxes near(others, moves);
    std::size_t met = 0;
    for (std::size_t i = 0; i < seeds.size(); i += 10) {
      const double row[] = {seeds.coordinate(i, 0), seeds.coordinate(i, 1), seeds.coordinate(i, 2),
                            seeds.weights[i]};
      const double radius = random.uniform(0.01, 0.1);
      CutTest cell(row, radius, 3);
      cell.move_to({radius, 0, 0});
      near.set(row, radius);
      std::vector<int> expected;
      bool is_empty = true;
      for (int shard = 0; shard < 40; ++shard) {
        const PackedTree& box = boxes[static_cast<std::size_t>(shard)];
        if (shard == 7 || box.levels() == 0) continue;
        is_empty = is_empty && !cell.may_meet(box.low.data(), box.high.data(), box.weight[0]);
        if (exchange::node_may_cut(box, 0, cell)) expected.push_back(shard);
      }
      std::vector<exchange::NearBoxes::View> views;
      near.views_at(cell.at(), views);
      std::vector<int> found;
      for (const exchange::NearBoxes::View& view : views) {
        found.push_back(view.shard);
        CHECK(near.may_cut_at(view, cell.at()));
        CHECK(std::equal(row, row + 4, near.row(view).begin()));
      }
      std::sort(found.begin(), found.end());
      CHECK(found == expected);
      CHECK(near.empty() == is_empty);
      CHECK(near.may_meet(row, radius) == !is_empty);
      met += expected.size();
    }
    CHECK(met > 100);
  }
}

TEST_CASE("coarse trees: far shards are not asked for theirs, unless they have a heavy seed") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 4000, 2, random);
  const std::size_t slabs = 10;
  std::vector<Shard> shards = shards_that_met(in_slabs(seeds, slabs));
  for (int s = 0; s < static_cast<int>(slabs); ++s) {
    std::set<int> beside;
    if (s > 0) beside.insert(s - 1);
    if (s + 1 < static_cast<int>(slabs)) beside.insert(s + 1);
    CHECK(asked_by(shards[static_cast<std::size_t>(s)]) == beside);
  }
  // One seed whose bisector with all others is in the first slab.
  std::size_t last = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (seeds.coordinate(i, 0) > seeds.coordinate(last, 0)) last = i;
  seeds.weights[last] += 0.8;
  shards = shards_that_met(in_slabs(seeds, slabs));
  for (std::size_t s = 1; s + 1 < slabs; ++s)
    CHECK(asked_by(shards[s]).contains(static_cast<int>(slabs) - 1));
  Diagram diagram = diagram_of(unit_box(2), seeds);
  check_shares(diagram, in_slabs(seeds, slabs));
}

TEST_CASE("coarse trees: what a shard is sent does not grow with their number, but for a box of each") {
  INFO(replay_hint());
  Random random(test_seed());
  const auto bytes_of_a_shard = [&random](std::size_t count) {
    const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 120 * count, 2, random);
    Diagram diagram = diagram_of(unit_box(2), seeds);
    const exchange::ExchangeReport report = check_shares(diagram, along_curve(seeds, count));
    const double box = 5 * sizeof(double) + 2 * sizeof(std::uint32_t);
    return static_cast<double>(report.outlines) / static_cast<double>(count) -
           box * static_cast<double>(count - 1);
  };
  const double few = bytes_of_a_shard(16);
  CHECK(few > 0);
  CHECK(bytes_of_a_shard(100) < 1.6 * few);  // 1.35 by the neighbours of squares in 4 x 4 and 10 x 10
}

TEST_CASE("coarse trees: many small shards, of weights that reach over several") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3}) {
    SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 600, dimension, random);
    for (int heavy = 0; heavy < 3; ++heavy) seeds.weights[random.index(seeds.size())] += 0.05;
    Diagram diagram = diagram_of(unit_box(dimension), seeds);
    check_shares(diagram, along_curve(seeds, 60));
    check_shares(diagram, at_random(seeds, 30, random));
  }
}
