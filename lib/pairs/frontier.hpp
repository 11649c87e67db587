/// \file
/// The tree nodes and seeds that are still in question for a part. Internal.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lib/seeds/packed_tree.hpp"

namespace powercell::pairs {

/// A seed (level -1, index = rank) or node `index` of a level of the packed tree.
struct Entry {
  std::uint32_t index;
  std::int8_t level;
  /// All its seeds are candidates already; it stays only because they may exclude others.
  bool settled;

  bool is_seed() const { return level < 0; }
};

/// Disjoint entries that hold all seeds not yet excluded.
using Frontier = std::vector<Entry>;

/// Ranks [begin, end).
struct RankRange {
  std::uint32_t begin, end;
};

inline Frontier root_frontier(const PackedTree& tree) {
  return {{0, static_cast<std::int8_t>(tree.levels() - 1), false}};
}

/// The seeds below an entry.
inline RankRange ranks(const PackedTree& tree, Entry e) {
  if (e.is_seed()) return {e.index, e.index + 1};
  const std::uint64_t width = std::uint64_t{PackedTree::fan} << (3 * e.level);  // fan^(level + 1)
  const std::uint64_t begin = e.index * width;
  return {static_cast<std::uint32_t>(begin),
          static_cast<std::uint32_t>(std::min<std::uint64_t>(begin + width, tree.seeds))};
}
static_assert(PackedTree::fan == 8, "ranks() counts in powers of 8");

/// Calls body(child) for the children of a node that is no seed.
template <class Body>
void for_children(const PackedTree& tree, Entry e, const Body& body) {
  const std::size_t below = e.level == 0 ? tree.seeds
                                         : tree.level_offset[static_cast<std::size_t>(e.level)] -
                                               tree.level_offset[static_cast<std::size_t>(e.level) - 1];
  const std::size_t first = std::size_t{e.index} * PackedTree::fan;
  const std::size_t last = std::min(first + PackedTree::fan, below);
  for (std::size_t k = first; k < last; ++k)
    body(Entry{static_cast<std::uint32_t>(k), static_cast<std::int8_t>(e.level - 1), false});
}

}  // namespace powercell::pairs
