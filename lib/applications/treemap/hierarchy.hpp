/// \file
/// The tree of a treemap: validated, with sums of values, in the order of levels.
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
  std::vector<double> value;  ///< for a group the sum of its leaves; 0 if dropped
  std::vector<std::uint32_t> depth;
  std::size_t root = 0;
  std::vector<std::uint32_t> order;  ///< the nodes with a value, level by level
  std::vector<std::size_t> level;    ///< levels + 1: level k is [level[k], level[k+1]) of `order`

  std::size_t size() const { return kind.size(); }
  /// The children with a value, ascending.
  std::span<const std::uint32_t> children(std::size_t node) const {
    return std::span(child).subspan(child_offset[node], child_offset[node + 1] - child_offset[node]);
  }
  std::vector<std::size_t> child_offset;
  std::vector<std::uint32_t> child;
};

/// Name of a node in error messages.
using NodeName = std::function<std::string(std::size_t)>;

/// \throw Error invalid_argument as treemap()
Hierarchy make_hierarchy(const TreeView& tree, const NodeName& name);

}  // namespace powercell::treemap_detail
