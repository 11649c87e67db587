/// \file
/// A guess which seeds of a shard the cells at the rim of another need, from positions alone. It decides what
/// is sent before any cell is clipped, and no result (docs/scale.md). Internal.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/exchange/messages.hpp"
#include "lib/exchange/tree_seeds.hpp"

namespace powercell::exchange {

/// The leaves of a shard's tree that are near the boxes of another's outline.
Rim find_rim(const TreeSeeds& seeds, const PackedTree& other);

/// Finds the seeds near leaves of another's rim. The memory is reused from leaf to leaf.
class NearRim {
 public:
  explicit NearRim(const TreeSeeds& seeds) : seeds_(seeds), tree_(seeds.tree) {}

  /// Whether nearly all leaves of the other shard have likely neighbours here. Then the two have no rim
  /// between them, and nearly all seeds would be sent. Tells by some leaves.
  bool is_everywhere(const Rim& rim);
  /// Appends the ranks of the seeds that are likely neighbours of those of leaf `k` of the rim.
  void find(const Rim& rim, std::size_t k, std::vector<std::uint32_t>& ranks);

 private:
  using Row = std::array<double, PackedTree::fan>;  // by seed of the rim's leaf

  /// Lists the leaves that may have likely neighbours. \return whether they are few
  bool find_leaves(const Rim& rim, std::size_t k, double far);
  /// Sets the squared distances of all seeds in them. \return the least of each seed of the rim's leaf
  Row measure(const double* rim_seeds);

  TreeSeeds seeds_;
  const PackedTree& tree_;
  std::vector<std::uint32_t> leaves_;
  std::vector<Row> distance2_;  // by seed in these leaves
};

}  // namespace powercell::exchange
