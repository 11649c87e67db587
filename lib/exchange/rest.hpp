/// \file
/// Outlines of the seeds of a shard that another was not sent. Internal.
#pragma once

#include <cstdint>
#include <span>

#include "lib/exchange/messages.hpp"
#include "lib/exchange/tree_seeds.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// An outline of the seeds that were not sent: nodes of the tree at `level`, and lower ones where seeds were
/// sent or the rim is near, down to boxes around the rest of a leaf.
/// \param level  of the tree's levels  \param rim  of the other shard  \param sent  ranks, ascending
PackedTree outline_of_rest(const TreeSeeds& seeds, std::size_t level, const Rim& rim,
                           std::span<const std::uint32_t> sent);
/// The same with a tree of boxes for the rim, in which a distance takes the place of a weight: nodes up to it
/// from the box are near.
PackedTree outline_of_rest(const TreeSeeds& seeds, std::size_t level, const PackedTree& rim,
                           std::span<const std::uint32_t> sent);

}  // namespace powercell::exchange
