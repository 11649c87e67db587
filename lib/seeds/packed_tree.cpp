#include "lib/seeds/packed_tree.hpp"

#include <algorithm>

#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t least_shared_seeds = 8192;  // nodes; fewer are faster on one thread

std::size_t level_size(const PackedTree& tree, std::size_t level) {
  return tree.level_offset[level + 1] - tree.level_offset[level];
}

/// Calls body(node, first, last) for each node of `level`, whose children are [first, last): ranks if it is a
/// leaf, else node numbers.
template <class Body>
void for_nodes(const PackedTree& tree, std::size_t level, int threads, const Body& body) {
  const std::size_t count = level_size(tree, level);
  const std::size_t below = level == 0 ? tree.seeds : level_size(tree, level - 1);
  const std::size_t base = level == 0 ? 0 : tree.level_offset[level - 1];
  parallel_for(threads_for(count, threads, least_shared_seeds), count,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t k = begin; k < end; ++k) {
                   const std::size_t first = k * PackedTree::fan;
                   const std::size_t last = std::min(first + PackedTree::fan, below);
                   body(tree.level_offset[level] + k, base + first, base + last);
                 }
               });
}

void fill_boxes(PackedTree& tree, std::size_t level, const double* low, const double* high, int threads) {
  const std::size_t d = static_cast<std::size_t>(tree.dimension);
  for_nodes(tree, level, threads, [&](std::size_t node, std::size_t first, std::size_t last) {
    for (std::size_t k = 0; k < d; ++k) {
      double a = low[first * d + k], b = high[first * d + k];
      for (std::size_t child = first + 1; child < last; ++child) {
        a = std::min(a, low[child * d + k]);
        b = std::max(b, high[child * d + k]);
      }
      tree.low[node * d + k] = a;
      tree.high[node * d + k] = b;
    }
  });
}

void fill_weights(PackedTree& tree, const SeedSet& seeds, int threads) {
  for (std::size_t level = 0; level < tree.levels(); ++level) {
    const double* below = level == 0 ? seeds.weights.data() : tree.weight.data();
    for_nodes(tree, level, threads, [&](std::size_t node, std::size_t first, std::size_t last) {
      tree.weight[node] = *std::max_element(below + first, below + last);
    });
  }
}

}  // namespace

PackedTree build_packed_tree(const SeedSet& seeds, int threads) {
  PackedTree tree;
  tree.dimension = seeds.dimension;
  tree.seeds = seeds.size();
  if (tree.seeds == 0) return tree;

  tree.level_offset.push_back(0);
  std::size_t count = tree.seeds;
  do {
    count = (count + PackedTree::fan - 1) / PackedTree::fan;
    tree.level_offset.push_back(tree.level_offset.back() + static_cast<std::uint32_t>(count));
  } while (count > 1);

  const std::size_t nodes = tree.level_offset.back();
  tree.low.resize(nodes * static_cast<std::size_t>(tree.dimension));
  tree.high.resize(tree.low.size());
  tree.weight.resize(nodes);
  const int workers = thread_count(threads);
  fill_boxes(tree, 0, seeds.positions.data(), seeds.positions.data(), workers);
  for (std::size_t level = 1; level < tree.levels(); ++level)
    fill_boxes(tree, level, tree.low.data(), tree.high.data(), workers);
  fill_weights(tree, seeds, workers);
  return tree;
}

void refit_weights(PackedTree& tree, const SeedSet& seeds, int threads) {
  fill_weights(tree, seeds, thread_count(threads));
}

}  // namespace powercell
