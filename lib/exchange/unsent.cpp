#include "lib/exchange/unsent.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "lib/exchange/boxes.hpp"
#include "lib/exchange/tree_of_boxes.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {
namespace {

/// The boxes of a boundary, each with the spacing of its seeds in the place of the weight.
PackedTree tree_of(const BoundaryLeaves& boundary, int dimension) {
  TreeOfBoxes boxes(dimension);
  const auto d = static_cast<std::size_t>(dimension);
  for (std::size_t k = 0; k < boundary.leaves(); ++k)
    boxes.add(box_around(&boundary.seed[k * PackedTree::fan * d], PackedTree::fan, d).view(),
              boundary.spacing[k]);
  return std::move(boxes).finish();
}

class Unsent {
 public:
  Unsent(const TreeSeeds& seeds, const PackedTree& boundary, std::span<const std::uint32_t> sent)
      : seeds_(seeds), tree_(seeds.tree), boundary_(boundary), sent_(sent), boxes_(tree_.dimension) {}

  /// Adds the boxes below a node of a level.
  void add(std::uint32_t node, std::uint32_t level) {
    const std::size_t size = std::size_t{PackedTree::fan} << (3 * level), first = node * size,
                      last = std::min(first + size, seeds_.size());
    const auto from = std::lower_bound(sent_.begin(), sent_.end(), first),
               to = std::lower_bound(from, sent_.end(), last);
    const auto sent = static_cast<std::size_t>(to - from);
    const std::uint32_t number = tree_.level_offset[level] + node;
    if (sent == last - first) return;
    if (level > 0 && (sent > 0 || is_near_boundary(number)))
      Walk(tree_).for_children({node, level, 0}, [&](std::uint32_t child) { add(child, level - 1); });
    else if (sent > 0)
      add_unsent_of_leaf(first, last);
    else
      boxes_.add(box_of(tree_, number), tree_.weight[number]);
  }
  PackedTree finish() && { return std::move(boxes_).finish(); }

 private:
  bool is_near_boundary(std::uint32_t number) const {
    const BoxView box = box_of(tree_, number);
    return has_open_leaf(boundary_, [&](std::uint32_t leaf) {
      const double spacing = boundary_.weight[leaf];
      return gap2(box, box_of(boundary_, leaf), static_cast<std::size_t>(tree_.dimension)) <=
             spacing * spacing;
    });
  }

  void add_unsent_of_leaf(std::size_t first, std::size_t last) {
    const auto d = static_cast<std::size_t>(tree_.dimension);
    std::vector<double> left;
    double heaviest = 0;
    for (std::size_t rank = first; rank < last; ++rank) {
      if (std::binary_search(sent_.begin(), sent_.end(), rank)) continue;
      heaviest = left.empty() ? seeds_.weights[rank] : std::max(heaviest, seeds_.weights[rank]);
      left.insert(left.end(), seeds_.position(rank), seeds_.position(rank) + d);
    }
    boxes_.add(box_around(left.data(), left.size() / d, d).view(), heaviest);
  }

  TreeSeeds seeds_;
  const PackedTree& tree_;
  const PackedTree& boundary_;
  std::span<const std::uint32_t> sent_;
  TreeOfBoxes boxes_;
};

}  // namespace

PackedTree coarse_tree_of_unsent(const TreeSeeds& seeds, const TreeCut& cut, const BoundaryLeaves& boundary,
                                 std::span<const std::uint32_t> sent) {
  return coarse_tree_of_unsent(seeds, cut, tree_of(boundary, seeds.tree.dimension), sent);
}

PackedTree coarse_tree_of_unsent(const TreeSeeds& seeds, const TreeCut& cut, const PackedTree& boundary,
                                 std::span<const std::uint32_t> sent) {
  Unsent unsent(seeds, boundary, sent);
  for (const TreeNode& node : cut) unsent.add(node.node, node.level);
  return std::move(unsent).finish();
}

}  // namespace powercell::exchange
