/// \file
/// The top of a shard's tree, by which others see whether its seeds could matter to them. Internal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "lib/exchange/boxes.hpp"
#include "lib/exchange/cut_test.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// The lowest level of a packed tree that has at most `most_nodes` nodes. \pre the tree has a level
std::size_t outline_level(const PackedTree& tree, std::size_t most_nodes);

/// The levels of a packed tree from outline_level() up. `seeds` of the result counts the nodes below that
/// level. Empty if the tree is.
PackedTree outline_of(const PackedTree& tree, std::size_t most_nodes);

/// Of all shards, by number.
using Outlines = std::shared_ptr<const std::vector<PackedTree>>;

/// What a shard knows of the seeds of others that it was not sent.
struct OthersSeeds {
  Outlines outlines;               ///< of all their seeds
  std::map<int, PackedTree> rest;  ///< by shard: an outline of those that are left

  const PackedTree& of(int shard) const {
    const auto found = rest.find(shard);
    return found == rest.end() ? (*outlines)[static_cast<std::size_t>(shard)] : found->second;
  }
};

std::size_t outline_bytes(const PackedTree& outline);

/// Whether a seed below the outline could cut off the point, or touch it.
bool may_cut(const PackedTree& outline, const CutTest& point);

/// The boxes of outlines that could cut a cell.
class NearBoxes {
 public:
  /// \param self  the shard that is left out
  NearBoxes(const OthersSeeds& others, int self) : others_(others), self_(self) {}

  /// Whether there are boxes for a cell of a seed in the box.
  /// \param farthest  that reaches as far as any, of a seed as light and as far from the origin as any
  bool may_meet(const BoxView& box, const CutTest& farthest) const;
  /// Finds the boxes for a cell.
  void set(const CutTest& cell);
  bool empty() const { return shards_.empty(); }
  /// Whether there are few.
  bool few() const { return complete_; }
  /// The shards that could cut off a point of that cell, or touch it, ascending.
  void shards_at(const CutTest& point, std::vector<int>& shards) const;

 private:
  static constexpr std::size_t most_boxes = 96;  // more are searched from the roots
  const PackedTree& outline(int shard) const { return others_.of(shard); }

  const OthersSeeds& others_;
  int self_;
  std::vector<int> shards_;         // whose boxes they are
  std::vector<std::size_t> end_;    // per shard: of its boxes
  std::vector<std::uint32_t> box_;  // nodes of the outline of their shard
  bool complete_ = true;            // whether box_ has all boxes
};

/// Whether a box of the outline contains the position.
bool may_contain(const PackedTree& outline, const double* position);

}  // namespace powercell::exchange
