#include "lib/seeds/packed_tree.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Compares every node with the ranks below it, which follow from the numbering alone.
void check_tree(const PackedTree& tree, const SeedSet& seeds) {
  const std::size_t d = static_cast<std::size_t>(seeds.dimension);
  REQUIRE(tree.seeds == seeds.size());
  REQUIRE(tree.levels() > 0);
  REQUIRE(tree.level_offset[tree.levels()] - tree.level_offset[tree.levels() - 1] == 1);
  REQUIRE(tree.weight.size() == tree.level_offset.back());
  REQUIRE(tree.low.size() == tree.weight.size() * d);
  std::size_t width = 1;
  for (std::size_t level = 0; level < tree.levels(); ++level) {
    width *= PackedTree::fan;
    const std::size_t nodes = tree.level_offset[level + 1] - tree.level_offset[level];
    REQUIRE(nodes == (seeds.size() + width - 1) / width);
    for (std::size_t node = 0; node < nodes; ++node) {
      const std::size_t first = node * width, last = std::min(first + width, seeds.size());
      const std::size_t at = tree.level_offset[level] + node;
      REQUIRE(tree.weight[at] ==
              *std::max_element(seeds.weights.begin() + static_cast<std::ptrdiff_t>(first),
                                seeds.weights.begin() + static_cast<std::ptrdiff_t>(last)));
      for (std::size_t k = 0; k < d; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t rank = first; rank < last; ++rank) {
          low = std::min(low, seeds.positions[rank * d + k]);
          high = std::max(high, seeds.positions[rank * d + k]);
        }
        REQUIRE(tree.low[at * d + k] == low);
        REQUIRE(tree.high[at * d + k] == high);
      }
    }
  }
}

double mean_leaf_side(const PackedTree& tree) {
  double sum = 0;
  for (std::size_t x = 0; x < tree.level_offset[1] * static_cast<std::size_t>(tree.dimension); ++x)
    sum += tree.high[x] - tree.low[x];
  return sum / static_cast<double>(tree.level_offset[1]) / tree.dimension;
}

}  // namespace

TEST_CASE("each node has the bounding box and largest weight of the seeds below") {
  INFO(replay_hint());
  for (const int d : {2, 3})
    for (const std::size_t n : {1, 7, 8, 9, 64, 65, 513, 100000}) {
      Random random(test_seed());
      const SeedArray array = random_seeds(Distribution::cluster, WeightRange::W2, n, d, random);
      SeedSet seeds = make_seed_set(array.view(), d, 2);
      PackedTree tree = build_packed_tree(seeds, 2);
      check_tree(tree, seeds);
      for (double& w : seeds.weights) w = random.uniform(-5, 5);
      refit_weights(tree, seeds, 2);
      check_tree(tree, seeds);
    }
}

TEST_CASE("the tree of no seeds is empty") {
  const SeedSet none = make_seed_set({2, {}, {}}, 2, 1);
  const PackedTree tree = build_packed_tree(none, 1);
  CHECK(tree.levels() == 0);
  CHECK(tree.low.empty());
}

TEST_CASE("leaves of white seeds are compact") {
  INFO(replay_hint());
  for (const int d : {2, 3}) {
    Random random(test_seed());
    const SeedArray array = random_seeds(Distribution::white, WeightRange::W0, 100000, d, random);
    const PackedTree tree = build_packed_tree(make_seed_set(array.view(), d, 2), 2);
    // The side of a cube that contains eight seeds on average; the box of eight seeds in curve order is
    // similar.
    const double side = std::pow(8.0 / 100000, 1.0 / d);
    CHECK(mean_leaf_side(tree) < 1.2 * side);
  }
}
