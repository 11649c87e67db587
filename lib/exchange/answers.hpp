/// \file
/// Answers to another shard's queries: seeds near its boundary, and seeds that cut off vertices of its cells.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "lib/exchange/messages.hpp"
#include "lib/exchange/tree_seeds.hpp"

namespace powercell::exchange {

/// Ranks of likely neighbours of the seeds in the boundary leaves, ascending.
/// \param own  as in NearBoundary
std::vector<std::uint32_t> ranks_near(const TreeSeeds& seeds, const BoundaryLeaves& boundary, int threads,
                                      std::pair<std::size_t, std::size_t> own = {});

/// Whether the seed of a rank may be part of an answer.
using MaySend = std::function<bool(std::uint32_t rank)>;

struct FirstSeeds {
  std::vector<std::uint32_t> rank;  ///< by cell; some more than once
  std::vector<std::uint8_t> found;  ///< by vertex: 1 if there is one
};

/// Finds, for each vertex, the seed whose bisector is crossed first on the way from the cell's seed to the
/// vertex.
FirstSeeds first_seeds(const TreeSeeds& seeds, const Request& request, const MaySend& may_send, int threads);

}  // namespace powercell::exchange
