#include "lib/seeds/hilbert.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

bool is_permutation_of_all(std::vector<std::uint32_t> order, std::size_t n) {
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0u);
  return order == all;
}

/// Mean over all points of the distance to the previous point divided by the distance to the origin, at
/// most 1.
double mean_relative_step(const SeedArray& seeds, const std::vector<std::uint32_t>& order) {
  double sum = 0;
  for (std::size_t k = 1; k < order.size(); ++k) {
    double step = 0, from_middle = 0;
    for (int c = 0; c < seeds.dimension; ++c) {
      step += std::pow(seeds.coordinate(order[k], c) - seeds.coordinate(order[k - 1], c), 2);
      from_middle += std::pow(seeds.coordinate(order[k], c), 2);
    }
    sum += std::min(1.0, std::sqrt(step / from_middle));
  }
  return sum / static_cast<double>(order.size());
}

}  // namespace

TEST_CASE("the curve visits each cell of a small grid once, each adjacent to the one before") {
  // The cells of the coarsest levels are given by the high bits of the coordinates.
  constexpr std::uint32_t side = 16;
  std::vector<std::pair<std::uint64_t, std::array<std::uint32_t, 2>>> flat;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      flat.push_back({hilbert_key<2>({x << (hilbert_bits<2> - 4), y << (hilbert_bits<2> - 4)}), {x, y}});
  std::vector<std::pair<std::uint64_t, std::array<std::uint32_t, 3>>> solid;
  for (std::uint32_t k = 0; k < side * side * side; ++k) {
    const std::uint32_t x = k % side, y = k / side % side, z = k / side / side;
    const int shift = hilbert_bits<3> - 4;
    solid.push_back({hilbert_key<3>({x << shift, y << shift, z << shift}), {x, y, z}});
  }
  const auto check = [](auto cells) {
    std::sort(cells.begin(), cells.end());
    for (std::size_t k = 1; k < cells.size(); ++k) {
      REQUIRE(cells[k].first != cells[k - 1].first);
      int moved = 0;
      for (std::size_t c = 0; c < cells[k].second.size(); ++c)
        moved += std::abs(static_cast<int>(cells[k].second[c]) - static_cast<int>(cells[k - 1].second[c]));
      REQUIRE(moved == 1);
    }
  };
  check(flat);
  check(solid);
}

TEST_CASE("the order is a permutation and does not depend on the number of threads") {
  INFO(replay_hint());
  for (const int d : {2, 3}) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W0, 150000, d, random);
    for (std::size_t i = 0; i < 70000; ++i)  // many in one grid cell, many at one position
      for (int k = 0; k < d; ++k)
        seeds.coordinate(2 * i, k) = i % 3 == 0 ? 0.25 : 0.25 + 1e-12 * random.uniform();
    const std::vector<std::uint32_t> order = hilbert_order(seeds.positions, d, 1);
    CHECK(is_permutation_of_all(order, seeds.size()));
    for (const int threads : {2, 3, 7}) CHECK(hilbert_order(seeds.positions, d, threads) == order);
  }
}

TEST_CASE("keys ascend along the order of points in the same box") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int dimension : {2, 3}) {
    SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W0, 5000, dimension, random);
    std::vector<double> low(3, 1), high(3, 0);
    for (std::size_t i = 0; i < seeds.size(); ++i)
      for (int k = 0; k < dimension; ++k) {
        const auto at = static_cast<std::size_t>(k);
        low[at] = std::min(low[at], seeds.coordinate(i, k));
        high[at] = std::max(high[at], seeds.coordinate(i, k));
      }
    const std::vector<std::uint64_t> keys = hilbert_keys(seeds.positions, dimension, low, high, 2);
    const std::vector<std::uint32_t> order = hilbert_order(seeds.positions, dimension, 1);
    REQUIRE(keys.size() == seeds.size());
    CHECK(std::is_sorted(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; }));
    CHECK(keys[order.front()] < keys[order.back()]);
    CHECK(hilbert_keys(seeds.positions, dimension, low, high, 1) == keys);
  }
  const std::vector<double> one{0.5, 0.5};
  CHECK(hilbert_keys(one, 2, one, one, 1) == std::vector<std::uint64_t>{0});
  CHECK(hilbert_keys({}, 2, {}, {}, 1).empty());
}

TEST_CASE("equal positions are consecutive, by ascending index") {
  INFO(replay_hint());
  for (const int d : {2, 3}) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 5000, d, random);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const std::size_t from = random.index(500);
      for (int k = 0; k < d; ++k) seeds.coordinate(i, k) = seeds.coordinate(from, k);
    }
    seeds.coordinate(0, 0) = 0.0;
    const std::vector<std::uint32_t> order = hilbert_order(seeds.positions, d, 1);
    const auto same = [&](std::uint32_t i, std::uint32_t j) {
      for (int k = 0; k < d; ++k)
        if (seeds.coordinate(i, k) != seeds.coordinate(j, k)) return false;
      return true;
    };
    std::vector<std::uint32_t> firsts;
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k > 0 && same(order[k - 1], order[k]))
        CHECK(order[k - 1] < order[k]);
      else
        firsts.push_back(order[k]);
    }
    for (std::size_t a = 0; a < firsts.size(); ++a)
      for (std::size_t b = a + 1; b < firsts.size(); ++b) REQUIRE(!same(firsts[a], firsts[b]));
  }
}

TEST_CASE("clusters far below the grid's resolution are in good order") {
  INFO(replay_hint());
  for (const int d : {2, 3}) {
    Random random(test_seed());
    // Distances to the origin from 1 down to 1e-25; the grid of the whole box resolves 1e-9 (2D), 5e-7 (3D).
    SeedArray seeds;
    seeds.dimension = d;
    for (int i = 0; i < 20000; ++i) {
      const double radius = std::pow(10.0, random.uniform(-25, 0));
      for (int k = 0; k < d; ++k) seeds.positions.push_back(radius * random.uniform(-1, 1));
    }
    const std::vector<std::uint32_t> order = hilbert_order(seeds.positions, d, 1);
    CHECK(is_permutation_of_all(order, seeds.size()));
    // 800 seeds per decade are 347 per factor e of the distance r to the origin, spread over a circle or
    // sphere: their spacing is the d-th root of 2 pi / 347 (2D) or 4 pi / 347 (3D), in units of r. In an
    // order that does not refine clusters, steps would be about r long.
    const double spacing = std::pow((d == 2 ? 2 : 4) * 3.14159 / 347, 1.0 / d);
    CHECK(mean_relative_step(seeds, order) < 1.3 * spacing);
  }
}

TEST_CASE("extreme and coinciding positions are ordered") {
  constexpr double huge = std::numeric_limits<double>::max();
  constexpr double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<double> extent = {-huge, -huge, huge, huge, 0, 0, -huge, huge, huge, -huge, 1, 1,
                                      -huge, 0,     huge, 0,    0, 1, 1,     0,    2,    2,     3, 3};
  CHECK(is_permutation_of_all(hilbert_order(extent, 2, 1), 12));
  std::vector<double> denormal;
  for (int k = 0; k < 100; ++k) denormal.push_back(tiny * (k * 37 % 100)), denormal.push_back(tiny * (k % 7));
  CHECK(is_permutation_of_all(hilbert_order(denormal, 2, 1), 100));
  // Each refinement splits off a few points: the deepest recursion that doubles allow.
  std::vector<double> geometric;
  for (int k = 0; k < 2000; ++k)
    for (int c = 0; c < 3; ++c) geometric.push_back(std::ldexp(1.0, 1000 - k));
  CHECK(is_permutation_of_all(hilbert_order(geometric, 3, 1), 2000));
  CHECK(hilbert_order({}, 2, 1).empty());
  const std::vector<double> equal(3 * 100000, 0.5);
  const std::vector<std::uint32_t> order = hilbert_order(equal, 3, 2);
  CHECK(std::is_sorted(order.begin(), order.end()));
}
