/// \file
/// The top of a shard's tree, by which others see whether its seeds could matter to them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lib/exchange/cut_test.hpp"
#include "lib/exchange/messages.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// A node of a packed tree, by its place in its level.
struct TreeNode {
  std::uint32_t node, level;
};

/// Nodes of a packed tree, in its order, that have each seed below them once.
using TreeCut = std::vector<TreeNode>;

/// The lowest level of a packed tree that has at most `most_nodes` nodes.
/// \pre the tree has a level
std::size_t coarse_level(const PackedTree& tree, std::size_t most_nodes);

/// All nodes of a level.
TreeCut level_cut(const PackedTree& tree, std::size_t level);
/// Nodes of a level near the part, and higher ones that are far from it: farther than their edge and the
/// radius by which their heaviest seed reaches beyond the lightest of the part.
TreeCut cut_near(const PackedTree& tree, std::size_t level, const NearPart& part);

/// The levels of a packed tree from coarse_level() up. `seeds` of the result counts the nodes below that
/// level. Empty if the tree is.
PackedTree coarse_tree_of(const PackedTree& tree, std::size_t most_nodes);
/// The boxes of nodes, with levels above them.
PackedTree coarse_tree_of(const PackedTree& tree, const TreeCut& cut);

std::size_t coarse_tree_bytes(const PackedTree& coarse_tree);

/// Whether seeds in a node could cut off the point, or touch it.
bool node_may_cut(const PackedTree& coarse_tree, std::uint32_t node, const CutTest& point);

/// Whether a seed below the coarse tree could cut off the point, or touch it.
bool may_cut(const PackedTree& coarse_tree, const CutTest& point);

/// Whether a box of the coarse tree contains the position.
bool may_contain(const PackedTree& coarse_tree, const double* position);

}  // namespace powercell::exchange
