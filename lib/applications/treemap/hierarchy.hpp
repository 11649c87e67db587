/// \file
/// The tree of a treemap: checked, summed up, in order of levels. Internal.
#pragma once

#include <cstdint>
#include <functional>
#include <powercell/treemap.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell::treemap_detail {

struct Hierarchy {
  std::vector<TreeNode> kind;
  std::vector<double> value;  ///< of a group the sum of its leaves; 0 where dropped
  std::vector<std::uint32_t> depth;
  std::size_t root = 0;
  /// Nodes that have a value, by level, and where each level begins (one more at the end).
  std::vector<std::uint32_t> order;
  std::vector<std::size_t> level;

  std::size_t size() const { return kind.size(); }
  /// Those with a value, in the order of the nodes.
  std::span<const std::uint32_t> children(std::size_t node) const {
    return std::span(child).subspan(child_offset[node], child_offset[node + 1] - child_offset[node]);
  }
  std::vector<std::size_t> child_offset;
  std::vector<std::uint32_t> child;
};

/// How messages call a node.
using NodeName = std::function<std::string(std::size_t)>;

/// \throw Error invalid_argument as treemap()
Hierarchy make_hierarchy(const TreeView& tree, const NodeName& name);

}  // namespace powercell::treemap_detail
