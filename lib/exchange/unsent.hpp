/// \file
/// Coarse trees of the seeds of a shard that another was not sent.
#pragma once

#include <cstdint>
#include <span>

#include "lib/exchange/coarse_tree.hpp"
#include "lib/exchange/messages.hpp"
#include "lib/exchange/tree_seeds.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// A coarse tree of the seeds that were not sent: nodes of the cut, and lower ones where seeds were sent or
/// the boundary is near, down to boxes around the rest of a leaf. \param cut  of the tree \param boundary  of
/// the other shard \param sent  ranks, ascending
PackedTree coarse_tree_of_unsent(const TreeSeeds& seeds, const TreeCut& cut, const BoundaryLeaves& boundary,
                                 std::span<const std::uint32_t> sent);
/// The same with a tree of boxes for the boundary, in which a distance takes the place of a weight: nodes up
/// to it from the box are near.
PackedTree coarse_tree_of_unsent(const TreeSeeds& seeds, const TreeCut& cut, const PackedTree& boundary,
                                 std::span<const std::uint32_t> sent);

}  // namespace powercell::exchange
