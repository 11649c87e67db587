/// \file
/// Seeds in the order of a packed tree over them, wherever they are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "lib/seeds/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell::exchange {

/// Nothing is owned.
struct TreeSeeds {
  const PackedTree& tree;
  std::span<const double> positions;  ///< rows, by rank
  std::span<const double> weights;    ///< by rank

  TreeSeeds(const PackedTree& tree, std::span<const double> positions, std::span<const double> weights)
      : tree(tree), positions(positions), weights(weights) {}
  TreeSeeds(const SeedSet& seeds, const PackedTree& tree) : TreeSeeds(tree, seeds.positions, seeds.weights) {}

  std::size_t size() const { return weights.size(); }
  std::size_t dimension() const { return static_cast<std::size_t>(tree.dimension); }
  const double* position(std::size_t rank) const { return &positions[rank * dimension()]; }
  /// The ranks below a node of a number, from the first one to behind the last one.
  std::pair<std::size_t, std::size_t> ranks_of(std::uint32_t number) const {
    std::size_t level = 0;
    while (number >= tree.level_offset[level + 1]) ++level;
    const std::size_t below = std::size_t{PackedTree::fan} << (3 * level),
                      first = (number - tree.level_offset[level]) * below;
    return {first, std::min(first + below, size())};
  }
  /// The ranks of a leaf are [first_of(leaf), first_of(leaf + 1)).
  std::size_t first_of(std::size_t leaf) const { return std::min(leaf * PackedTree::fan, size()); }
};

}  // namespace powercell::exchange
