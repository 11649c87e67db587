/// \file
/// A packed tree over boxes in the place of seeds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "lib/exchange/boxes.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// Nodes of the lowest level are boxes that are given, one after the other.
class TreeOfBoxes {
 public:
  explicit TreeOfBoxes(int dimension) : d_(static_cast<std::size_t>(dimension)) {
    tree_.dimension = dimension;
  }

  /// Takes memory for so many boxes.
  void reserve(std::size_t boxes) {
    const std::size_t nodes = boxes + boxes / (PackedTree::fan - 1) + 16;
    tree_.low.reserve(nodes * d_);
    tree_.high.reserve(nodes * d_);
    tree_.weight.reserve(nodes);
  }

  void add(const BoxView& box, double weight) {
    tree_.low.insert(tree_.low.end(), box.low, box.low + d_);
    tree_.high.insert(tree_.high.end(), box.high, box.high + d_);
    tree_.weight.push_back(weight);
  }

  /// With the levels above the boxes; `seeds` counts the boxes.
  PackedTree finish() && {
    std::size_t first = 0, last = tree_.weight.size();
    tree_.seeds = last;
    if (last > 0) tree_.level_offset = {0, static_cast<std::uint32_t>(last)};
    while (last - first > 1) {
      for (std::size_t at = first; at < last; at += PackedTree::fan)
        add_around(at, std::min(at + PackedTree::fan, last));
      first = std::exchange(last, tree_.weight.size());
      tree_.level_offset.push_back(static_cast<std::uint32_t>(last));
    }
    return std::move(tree_);
  }

 private:
  /// Adds the smallest box around those of the nodes [first, last).
  void add_around(std::size_t first, std::size_t last) {
    Box box;
    for (std::size_t k = 0; k < d_; ++k) {
      box.low[k] = tree_.low[first * d_ + k];
      box.high[k] = tree_.high[first * d_ + k];
      for (std::size_t node = first + 1; node < last; ++node) {
        box.low[k] = std::min(box.low[k], tree_.low[node * d_ + k]);
        box.high[k] = std::max(box.high[k], tree_.high[node * d_ + k]);
      }
    }
    add(box.view(), *std::max_element(&tree_.weight[first], tree_.weight.data() + last));
  }

  std::size_t d_;
  PackedTree tree_;
};

}  // namespace powercell::exchange
