#include "lib/applications/treemap/hierarchy.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "lib/base/text.hpp"

namespace powercell::treemap_detail {
namespace {

// Smallest share of the whole: rounding the coordinates of a smaller cell changes its area by more than 1e-7.
constexpr double least_share = 1e-16;

[[noreturn]] void refuse(const std::string& why) {
  throw Error(ErrorCode::invalid_argument, "treemap: " + why);
}

std::size_t find_root(const TreeView& tree, const NodeName& name) {
  const auto n = static_cast<std::int64_t>(tree.parent.size());
  std::size_t root = tree.parent.size();
  for (std::size_t i = 0; i < tree.parent.size(); ++i) {
    const std::int64_t parent = tree.parent[i];
    if (parent != TreeView::no_parent && (parent < 0 || parent >= n))
      refuse(name(i) + " has the parent " + std::to_string(parent) + ", but there are " + std::to_string(n) +
             " nodes");
    if (!std::isfinite(tree.value[i])) refuse("the value of " + name(i) + " is not finite");
    if (parent != TreeView::no_parent) continue;
    if (root < tree.parent.size())
      refuse(name(root) + " and " + name(i) + " both have no parent; a tree has one root");
    root = i;
  }
  if (root == tree.parent.size()) refuse("every node has a parent, so there is no root");
  return root;
}

/// Lists the children of each node that are not dropped.
void list_children(const TreeView& tree, const std::vector<TreeNode>& kind, std::vector<std::size_t>& offset,
                   std::vector<std::uint32_t>& child) {
  const std::size_t n = tree.parent.size();
  const auto listed = [&](std::size_t i) {
    return tree.parent[i] != TreeView::no_parent && kind[i] != TreeNode::dropped;
  };
  offset.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i)
    if (listed(i)) ++offset[static_cast<std::size_t>(tree.parent[i]) + 1];
  for (std::size_t i = 0; i < n; ++i) offset[i + 1] += offset[i];
  child.resize(offset[n]);
  std::vector<std::size_t> next(offset.begin(), offset.end() - 1);
  for (std::size_t i = 0; i < n; ++i)
    if (listed(i)) child[next[static_cast<std::size_t>(tree.parent[i])]++] = static_cast<std::uint32_t>(i);
}

/// Orders the nodes breadth first from the root.
void order_by_level(Hierarchy& h) {
  h.order.assign(1, static_cast<std::uint32_t>(h.root));
  h.level.assign(1, 0);
  h.depth.assign(h.size(), 0);
  for (std::size_t begin = 0; begin < h.order.size(); begin = h.level.back()) {
    const std::size_t end = h.order.size();
    h.level.push_back(end);
    for (std::size_t k = begin; k < end; ++k)
      for (const std::uint32_t c : h.children(h.order[k])) {
        h.depth[c] = static_cast<std::uint32_t>(h.level.size()) - 1;
        h.order.push_back(c);
      }
  }
}

void refuse_cycle(const Hierarchy& h, const TreeView& tree, const NodeName& name) {
  std::vector<bool> reached(h.size());
  for (const std::uint32_t i : h.order) reached[i] = true;
  std::size_t node = 0;
  while (reached[node]) ++node;
  for (std::size_t k = 0; k < h.size(); ++k) node = static_cast<std::size_t>(tree.parent[node]);
  refuse(name(node) + " is among its own ancestors (a cycle)");
}

void sum_values(Hierarchy& h, const TreeView& tree) {
  for (std::size_t k = h.order.size(); k-- > 0;) {
    const std::uint32_t i = h.order[k];
    const auto children = h.children(i);
    if (children.empty()) h.value[i] = tree.value[i] > 0 ? tree.value[i] : 0;
    for (const std::uint32_t c : children) h.value[i] += h.value[c];
    h.kind[i] = h.value[i] <= 0 ? TreeNode::dropped : children.empty() ? TreeNode::leaf : TreeNode::group;
  }
}

void check_range(const Hierarchy& h, const NodeName& name) {
  const double total = h.value[h.root];
  if (!(total > 0)) refuse("no node has a value above 0, so there is nothing to lay out");
  if (!std::isfinite(total))
    refuse("the values sum to more than a double holds; divide them by a common number");
  for (std::size_t i = 0; i < h.size(); ++i) {
    if (h.kind[i] != TreeNode::leaf || h.value[i] >= least_share * total) continue;
    refuse("the value of " + name(i) + " is " + digits(h.value[i] / total, 2) +
           " of the sum; a cell below 1e-16 of the outline has no exact area in double coordinates");
  }
}

}  // namespace

Hierarchy make_hierarchy(const TreeView& tree, const NodeName& given) {
  const NodeName name = given ? given : [](std::size_t i) { return "node " + std::to_string(i); };
  const std::size_t n = tree.parent.size();
  if (n == 0) refuse("the tree has no nodes");
  if (n != tree.value.size())
    refuse(std::to_string(n) + " parents and " + std::to_string(tree.value.size()) + " values");
  if (n > std::numeric_limits<std::uint32_t>::max()) refuse("more than 2^32 - 1 nodes");
  Hierarchy h;
  h.root = find_root(tree, name);
  h.kind.assign(n, TreeNode::leaf);
  h.value.assign(n, 0);
  list_children(tree, h.kind, h.child_offset, h.child);
  order_by_level(h);
  if (h.order.size() != n) refuse_cycle(h, tree, name);
  sum_values(h, tree);
  check_range(h, name);
  const std::vector<std::uint32_t> depth = h.depth;
  list_children(tree, h.kind, h.child_offset, h.child);
  order_by_level(h);
  h.depth = depth;  // includes dropped nodes
  return h;
}

}  // namespace powercell::treemap_detail
