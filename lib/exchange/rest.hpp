/// \file
/// Outlines of the seeds of a shard that another was not sent. Internal.
#pragma once

#include <cstdint>
#include <span>

#include "lib/exchange/messages.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// An outline of the seeds that were not sent: nodes of the tree at `level`, and lower ones where seeds were
/// sent or the rim is near, down to boxes around the rest of a leaf.
/// \param level  of the tree's levels  \param rim  of the other shard  \param sent  ranks, ascending
PackedTree outline_of_rest(const SeedSet& seeds, const PackedTree& tree, std::size_t level, const Rim& rim,
                           std::span<const std::uint32_t> sent);

}  // namespace powercell::exchange
