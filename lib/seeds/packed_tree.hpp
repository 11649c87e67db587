/// \file
/// An implicit packed tree over seeds in Hilbert order, with bounding boxes and largest weights.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Leaf k holds the ranks [8k, 8k+8); a node of level l+1 holds 8 consecutive nodes of level l. Level 0 is
/// the leaves, the last level the root. Nodes are numbered level by level: node k of level l is
/// level_offset[l] + k.
struct PackedTree {
  static constexpr std::uint32_t fan = 8;  ///< children of a node
  int dimension = 0;
  std::size_t seeds = 0;
  std::vector<std::uint32_t> level_offset;  ///< levels + 1
  std::vector<double> low, high;            ///< nodes x d: bounding box of the positions below
  std::vector<double> weight;               ///< nodes: largest weight below
  std::size_t levels() const { return level_offset.empty() ? 0 : level_offset.size() - 1; }
};

PackedTree build_packed_tree(const SeedSet& seeds, int threads);
/// Updates the largest weights after the weights of `seeds` changed.
void refit_weights(PackedTree& tree, const SeedSet& seeds, int threads);

}  // namespace powercell
