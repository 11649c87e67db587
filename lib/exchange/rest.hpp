/// \file
/// Outlines of the seeds of a shard that another was not sent.
#pragma once

#include <cstdint>
#include <span>

#include "lib/exchange/messages.hpp"
#include "lib/exchange/outline.hpp"
#include "lib/exchange/tree_seeds.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// An outline of the seeds that were not sent: nodes of the cut, and lower ones where seeds were sent or the
/// rim is near, down to boxes around the rest of a leaf.
/// \param cut  of the tree
/// \param rim  of the other shard
/// \param sent  ranks, ascending
PackedTree outline_of_rest(const TreeSeeds& seeds, const TreeCut& cut, const Rim& rim,
                           std::span<const std::uint32_t> sent);
/// The same with a tree of boxes for the rim, in which a distance takes the place of a weight: nodes up to it
/// from the box are near.
PackedTree outline_of_rest(const TreeSeeds& seeds, const TreeCut& cut, const PackedTree& rim,
                           std::span<const std::uint32_t> sent);

}  // namespace powercell::exchange
