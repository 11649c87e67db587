/// \file
/// The top of a shard's tree, by which others see whether its seeds could matter to them. Internal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "lib/exchange/cut_test.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// The upper levels of a packed tree, the lowest of which has at most `most_nodes` nodes. `seeds` of the
/// result counts the nodes below that level. Empty if the tree is.
PackedTree outline_of(const PackedTree& tree, std::size_t most_nodes);

/// Of all shards, by number.
using Outlines = std::shared_ptr<const std::vector<PackedTree>>;

std::size_t outline_bytes(const PackedTree& outline);

/// Whether a seed below the outline could cut off the point, or touch it.
bool may_cut(const PackedTree& outline, const CutTest& point);

/// The boxes of outlines that could cut a cell.
class NearBoxes {
 public:
  /// \param self  the shard that is left out
  NearBoxes(Outlines outlines, int self) : outlines_(std::move(outlines)), self_(self) {}

  /// Finds the boxes for a cell.
  void set(const CutTest& cell);
  bool empty() const { return shards_.empty(); }
  /// Whether there are few.
  bool few() const { return complete_; }
  /// The shards that could cut off a point of that cell, or touch it, ascending.
  void shards_at(const CutTest& point, std::vector<int>& shards) const;

 private:
  static constexpr std::size_t most_boxes = 96;  // more are searched from the roots
  const PackedTree& outline(int shard) const { return (*outlines_)[static_cast<std::size_t>(shard)]; }

  Outlines outlines_;
  int self_;
  std::vector<int> shards_;         // whose boxes they are
  std::vector<std::size_t> end_;    // per shard: of its boxes
  std::vector<std::uint32_t> box_;  // nodes of the outline of their shard
  bool complete_ = true;            // whether box_ has all boxes
};

/// Whether a box of the outline contains the position.
bool may_contain(const PackedTree& outline, const double* position);

}  // namespace powercell::exchange
