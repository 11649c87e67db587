/// \file
/// Searches in packed trees from the root.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// Nodes still to visit.
class Walk {
 public:
  struct Entry {
    std::uint32_t node;  ///< of its level
    std::uint32_t level;
    double key;
  };

  explicit Walk(const PackedTree& tree) : tree_(tree) {}

  bool is_done() const { return depth_ == 0; }
  Entry pop() { return stack_[--depth_]; }
  void push(const Entry& entry) { stack_[depth_++] = entry; }
  /// Pushes an entry below those of larger keys that were pushed since the stack had `base` entries.
  void push_sorted(std::size_t base, const Entry& entry) {
    std::size_t at = depth_++;
    for (; at > base && stack_[at - 1].key < entry.key; --at) stack_[at] = stack_[at - 1];
    stack_[at] = entry;
  }
  std::size_t depth() const { return depth_; }

  /// Calls use(child) for the children of an entry above the lowest level.
  template <class Use>
  void for_children(const Entry& entry, const Use& use) const {
    const std::uint32_t count = tree_.level_offset[entry.level] - tree_.level_offset[entry.level - 1],
                        first = entry.node * PackedTree::fan;
    for (std::uint32_t child = first; child < std::min(first + PackedTree::fan, count); ++child) use(child);
  }
  /// The number of a node in the arrays of the tree.
  std::uint32_t number(std::uint32_t node, std::uint32_t level) const {
    return tree_.level_offset[level] + node;
  }

 private:
  static constexpr std::size_t most_levels = 11;  // of 2^30 seeds
  const PackedTree& tree_;
  std::array<Entry, most_levels * PackedTree::fan> stack_;
  std::size_t depth_ = 0;
};

/// Calls use(k) for the nodes k of the lowest level that, with all nodes above them, are open(number), until
/// it returns false.
template <class Open, class Use>
void visit_leaves(const PackedTree& tree, const Open& open, const Use& use) {
  if (tree.levels() == 0) return;
  Walk walk(tree);
  const auto top = static_cast<std::uint32_t>(tree.levels() - 1);
  if (open(walk.number(0, top))) walk.push({0, top, 0});
  while (!walk.is_done()) {
    const Walk::Entry entry = walk.pop();
    if (entry.level == 0) {
      if (!use(entry.node)) return;
      continue;
    }
    const std::uint32_t level = entry.level - 1;
    walk.for_children(entry, [&](std::uint32_t child) {
      if (open(walk.number(child, level))) walk.push({child, level, 0});
    });
  }
}

/// Whether a node of the lowest level, with all nodes above it, is open(number).
template <class Open>
bool has_open_leaf(const PackedTree& tree, const Open& open) {
  bool found = false;
  visit_leaves(tree, open, [&](std::uint32_t) {
    found = true;
    return false;
  });
  return found;
}

/// Calls use(k) for the nodes k of the lowest level with key(number) at most `limit`, which `use` may lower:
/// those of lower keys first. The key of a node must be no larger than those below it.
template <class Key, class Use>
void visit_nearest(const PackedTree& tree, const Key& key, const double& limit, const Use& use) {
  if (tree.levels() == 0) return;
  Walk walk(tree);
  const auto top = static_cast<std::uint32_t>(tree.levels() - 1);
  walk.push({0, top, key(walk.number(0, top))});
  while (!walk.is_done()) {
    const Walk::Entry entry = walk.pop();
    if (entry.key > limit) continue;
    if (entry.level == 0) {
      use(entry.node);
      continue;
    }
    const std::size_t base = walk.depth();
    const std::uint32_t level = entry.level - 1;
    walk.for_children(entry, [&](std::uint32_t child) {
      const double next = key(walk.number(child, level));
      if (!(next > limit)) walk.push_sorted(base, {child, level, next});
    });
  }
}

/// Whether the box of a node contains a position.
inline bool contains(const PackedTree& tree, std::uint32_t number, const double* position) {
  const auto d = static_cast<std::size_t>(tree.dimension);
  for (std::size_t k = 0; k < d; ++k)
    if (position[k] < tree.low[number * d + k] || position[k] > tree.high[number * d + k]) return false;
  return true;
}

}  // namespace powercell::exchange
