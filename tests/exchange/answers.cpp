// What is asked and answered, against all seeds in turn.
#include <doctest/doctest.h>

#include <set>

#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;
using exchange::CutTest;
using exchange::Point;

namespace {

/// The power distance of y, from seed i, to seed j, in long double.
long double power(const SeedArray& seeds, std::size_t i, const Point& y, std::size_t j) {
  long double sum = -static_cast<long double>(seeds.weights[j]);
  for (int k = 0; k < seeds.dimension; ++k) {
    const long double gap = static_cast<long double>(y[static_cast<std::size_t>(k)]) +
                            seeds.coordinate(i, k) - seeds.coordinate(j, k);
    sum += gap * gap;
  }
  return sum;
}

std::vector<double> row_of(const SeedArray& seeds, std::size_t i) {
  std::vector<double> row;
  for (int k = 0; k < seeds.dimension; ++k) row.push_back(seeds.coordinate(i, k));
  row.push_back(seeds.weights[i]);
  return row;
}

}  // namespace

TEST_CASE(
    "answers: every seed that cuts off a point is admitted, and those that tie, wherever its error puts it") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const double scale : {1e-90, 1e-6, 1.0, 1e60})
    for (int round = 0; round < 2000; ++round) {
      SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 2, 3, random);
      if (scale == 1.0) translate(seeds, {1e6, 0, 0});
      test::scale(seeds, scale);
      const double radius = scale * random.uniform(0.1, 2);
      Point y, off;
      for (std::size_t k = 0; k < 3; ++k) {
        y[k] = radius * random.uniform(-0.5, 0.5);
        off[k] = y[k] + radius * random.uniform(-1, 1) * 0x1p-20;
      }
      // A tie at the place where the point really is, but for rounding; every other time it is a cut.
      seeds.weights[1] =
          static_cast<double>(seeds.weights[1] + power(seeds, 0, off, 1) - power(seeds, 0, off, 0));
      if (round % 2 == 1) seeds.weights[1] += std::abs(seeds.weights[1]) * random.uniform();
      const std::vector<double> row = row_of(seeds, 0), other = row_of(seeds, 1);
      CutTest test(row.data(), radius, 3);
      test.move_to(y);
      CHECK(test.power(other.data(), other[3]) <= test.limit());
      Point low, high;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = other[k] - scale * random.uniform();
        high[k] = other[k] + scale * random.uniform();
      }
      CHECK(test.power(low.data(), high.data(), other[3]) <= test.limit());
      CHECK(test.may_meet(low.data(), high.data(), other[3]));
    }
}

TEST_CASE("answers: a seed is sent once, and only if it cuts or touches on the way to the vertex") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 300, 3, random);
  std::vector<std::uint64_t> ids(seeds.size() - 1);
  std::iota(ids.begin(), ids.end(), std::uint64_t{1});
  exchange::OwnSeeds own(ids, {3, std::span(seeds.positions).subspan(3), std::span(seeds.weights).subspan(1)},
                         3, 1);
  const std::vector<double> row = row_of(seeds, 0);
  std::set<std::uint64_t> sent;
  for (int round = 0; round < 200; ++round) {
    const double radius = random.uniform(0.01, 1);
    exchange::Request request;
    request.cell = row;
    request.cell.push_back(radius);
    request.end = {1};
    Point y;
    for (std::size_t k = 0; k < 3; ++k) {
      request.vertex.push_back(static_cast<float>(random.uniform(-0.5, 0.5)));
      y[k] = radius * static_cast<double>(request.vertex.back());
    }
    const exchange::Reply reply = own.answer(7, request);
    CHECK((reply.coarse_tree.levels() > 0) == (round == 0));  // who has one needs no other
    REQUIRE(reply.found.size() == 1);
    REQUIRE(reply.id.size() == reply.found[0]);
    for (const std::uint64_t id : reply.id) {
      CHECK(sent.insert(id).second);
      const long double at_vertex = power(seeds, 0, y, id) - power(seeds, 0, y, 0),
                        at_seed = power(seeds, 0, {}, id) - power(seeds, 0, {}, 0);
      CHECK(std::min(at_vertex, at_seed) <= 1e-5L * radius);
    }
    if (reply.found[0] == 0)
      for (std::size_t j = 1; j < seeds.size(); ++j)
        CHECK((sent.contains(j) || power(seeds, 0, y, j) > power(seeds, 0, y, 0)));
  }
  CHECK(sent.size() > 20);
}

TEST_CASE(
    "answers: a seed on the near side of the cell comes before one that cuts the vertex off behind it") {
  // Towards the vertex the first seed wins from 0.5 on, the second up to 0.7.
  const std::vector<std::uint64_t> ids{1, 2};
  const std::vector<double> positions{2, 0, -1, 0}, weights{2, 2.4};
  exchange::OwnSeeds own(ids, {2, positions, weights}, 2, 1);
  const exchange::Request request{{0, 0, 0, 1}, {1}, {1, 0}};
  CHECK(own.answer(0, request).id == std::vector<std::uint64_t>{2});
  CHECK(own.answer(0, request).id == std::vector<std::uint64_t>{1});
  const exchange::Reply last = own.answer(0, request);
  CHECK(last.id.empty());
  CHECK(last.found == std::vector<std::uint8_t>{0});
}

TEST_CASE("answers: how far cells reach is the distance of their farthest vertices") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const NamedDomain& named : std::vector<NamedDomain>{{"box", unit_box(3)},
                                                           {"islands", Domain::polygon(islands())},
                                                           {"ball", volume_of(ball_tetrahedra(0))}}) {
    INFO(named.name);
    const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W2, 200, random);
    std::vector<std::uint32_t> selected;
    for (std::uint32_t i = 0; i < seeds.size(); i += 2) selected.push_back(i);
    Diagram::State diagram(test_device(), named.domain, {});
    diagram.set_seeds(seeds.view());
    diagram.select(selected);
    diagram.compute({.adjacency = true, .cells = true, .reach = true});
    const Cells& cells = *diagram.results->cells;
    const std::vector<double>& reach = diagram.results->reach.value();
    REQUIRE(reach.size() == selected.size());
    for (std::size_t k = 0; k < selected.size(); ++k) {
      CAPTURE(selected[k]);
      if (diagram.results->measures->status[k] != SeedStatus::ok) continue;
      const std::vector<double> row = row_of(seeds, selected[k]);
      CHECK(reach[k] == doctest::Approx(exchange::radius_of(cells, k, row.data())).epsilon(1e-6));
    }
  }
}

TEST_CASE("answers: what may meet a cell may meet the farthest of the cells in a box") {
  INFO(replay_hint());
  Random random(test_seed());
  std::size_t met = 0, missed = 0;
  for (int round = 0; round < 3000; ++round) {
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 4, 3, random);
    translate(seeds, {random.uniform(0, 3), 0, 0});
    const double reach = random.uniform(0.01, 0.5);
    std::vector<double> farthest{0, 0, 0, seeds.weights[0]};
    Point low{seeds.coordinate(0, 0), seeds.coordinate(0, 1), seeds.coordinate(0, 2)}, high = low;
    for (std::size_t i = 0; i < 3; ++i) {
      farthest[3] = std::min(farthest[3], seeds.weights[i]);
      for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        low[axis] = std::min(low[axis], seeds.coordinate(i, k));
        high[axis] = std::max(high[axis], seeds.coordinate(i, k));
        farthest[axis] = std::max(std::abs(low[axis]), std::abs(high[axis]));
      }
    }
    const std::vector<double> other = row_of(seeds, 3);
    const double gap2 = exchange::gap2({low.data(), high.data()}, {other.data(), other.data()}, 3);
    const bool any = CutTest(farthest.data(), reach, 3).may_meet(gap2, other[3]);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<double> row = row_of(seeds, i);
      const bool one =
          CutTest(row.data(), reach * random.uniform(), 3).may_meet(other.data(), other.data(), other[3]);
      CHECK((any || !one));
      met += one;
    }
    missed += !any;
  }
  CHECK(met > 100);
  CHECK(missed > 100);
}

TEST_CASE("answers: the coarse tree of a tree admits what the tree does") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W1, 5000, 2, random);
  std::vector<std::uint64_t> ids(seeds.size());
  std::iota(ids.begin(), ids.end(), std::uint64_t{0});
  const exchange::OwnSeeds own(ids, seeds.view(), 2, 1);
  const PackedTree coarse_tree = exchange::coarse_tree_of(own.tree(), 100);
  CHECK(coarse_tree.levels() == own.tree().levels() - 1);
  CHECK(coarse_tree.level_offset[1] <= 100);
  for (std::size_t i = 0; i < seeds.size(); i += 50) {
    const std::vector<double> row = row_of(seeds, i);
    CHECK(exchange::may_contain(coarse_tree, row.data()));
    CutTest test(row.data(), 0.01, 2);
    const Point y{random.uniform(-0.01, 0.01), 0, 0};
    test.move_to(y);
    const bool is_cut = exchange::may_cut(coarse_tree, test);
    for (std::size_t j = 0; j < seeds.size(); ++j)
      if (power(seeds, i, y, j) <= power(seeds, i, y, i)) CHECK(is_cut);
  }
  CHECK(exchange::coarse_tree_of(own.tree(), 100000).level_offset == own.tree().level_offset);
}
