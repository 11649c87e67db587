#include "lib/exchange/coarse_tree.hpp"

#include <cmath>
#include <utility>

#include "lib/exchange/tree_of_boxes.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {

std::size_t coarse_level(const PackedTree& tree, std::size_t most_nodes) {
  std::size_t level = 0;
  while (level + 1 < tree.levels() && tree.level_offset[level + 1] - tree.level_offset[level] > most_nodes)
    ++level;
  return level;
}

TreeCut level_cut(const PackedTree& tree, std::size_t level) {
  TreeCut cut;
  for (std::uint32_t node = 0; node < tree.level_offset[level + 1] - tree.level_offset[level]; ++node)
    cut.push_back({node, static_cast<std::uint32_t>(level)});
  return cut;
}

namespace {

class CutNear {
 public:
  CutNear(const PackedTree& tree, std::size_t level, const NearPart& part)
      : tree_(tree), walk_(tree), level_(level), part_(part) {}

  void add(std::uint32_t node, std::uint32_t level) {
    if (level > level_ && is_near(walk_.number(node, level)))
      walk_.for_children({node, level, 0}, [&](std::uint32_t child) { add(child, level - 1); });
    else
      cut_.push_back({node, level});
  }
  TreeCut take() && { return std::move(cut_); }

 private:
  bool is_near(std::uint32_t number) const {
    const BoxView box = box_of(tree_, number);
    const auto d = static_cast<std::size_t>(tree_.dimension);
    const double above = tree_.weight[number] - part_.lightest,
                 reach = longest_edge(box, d) + (above > 0 ? std::sqrt(above) : 0);
    return gap2(box, part_.box.view(), d) <= reach * reach;
  }

  const PackedTree& tree_;
  Walk walk_;
  std::size_t level_;
  const NearPart& part_;
  TreeCut cut_;
};

}  // namespace

TreeCut cut_near(const PackedTree& tree, std::size_t level, const NearPart& part) {
  CutNear cut(tree, level, part);
  cut.add(0, static_cast<std::uint32_t>(tree.levels() - 1));
  return std::move(cut).take();
}

PackedTree coarse_tree_of(const PackedTree& tree, std::size_t most_nodes) {
  PackedTree top;
  top.dimension = tree.dimension;
  if (tree.levels() == 0) return top;
  const std::size_t lowest = coarse_level(tree, most_nodes);
  const auto d = static_cast<std::ptrdiff_t>(tree.dimension);
  const std::uint32_t first = tree.level_offset[lowest];
  top.seeds = lowest == 0 ? tree.seeds : first - tree.level_offset[lowest - 1];
  for (std::size_t level = lowest; level < tree.level_offset.size(); ++level)
    top.level_offset.push_back(tree.level_offset[level] - first);
  top.low.assign(tree.low.begin() + first * d, tree.low.end());
  top.high.assign(tree.high.begin() + first * d, tree.high.end());
  top.weight.assign(tree.weight.begin() + first, tree.weight.end());
  return top;
}

PackedTree coarse_tree_of(const PackedTree& tree, const TreeCut& cut) {
  TreeOfBoxes boxes(tree.dimension);
  for (const TreeNode& node : cut) {
    const std::uint32_t number = tree.level_offset[node.level] + node.node;
    boxes.add(box_of(tree, number), tree.weight[number]);
  }
  return std::move(boxes).finish();
}

std::size_t coarse_tree_bytes(const PackedTree& coarse_tree) {
  return bytes_of(coarse_tree.level_offset) + bytes_of(coarse_tree.low) + bytes_of(coarse_tree.high) +
         bytes_of(coarse_tree.weight);
}

bool node_may_cut(const PackedTree& coarse_tree, std::uint32_t node, const CutTest& point) {
  const auto d = static_cast<std::size_t>(coarse_tree.dimension);
  return !(point.power(&coarse_tree.low[node * d], &coarse_tree.high[node * d], coarse_tree.weight[node]) >
           point.limit());
}

bool may_cut(const PackedTree& coarse_tree, const CutTest& point) {
  return has_open_leaf(coarse_tree,
                       [&](std::uint32_t node) { return node_may_cut(coarse_tree, node, point); });
}

bool may_contain(const PackedTree& coarse_tree, const double* position) {
  return has_open_leaf(coarse_tree,
                       [&](std::uint32_t node) { return contains(coarse_tree, node, position); });
}

}  // namespace powercell::exchange
