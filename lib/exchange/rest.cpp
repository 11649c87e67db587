#include "lib/exchange/rest.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "lib/exchange/boxes.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {
namespace {

/// A packed tree over any boxes: leaves of one box each.
class TreeOfBoxes {
 public:
  explicit TreeOfBoxes(int dimension) : d_(static_cast<std::size_t>(dimension)) {
    tree_.dimension = dimension;
  }

  void add(const BoxView& box, double weight) {
    tree_.low.insert(tree_.low.end(), box.low, box.low + d_);
    tree_.high.insert(tree_.high.end(), box.high, box.high + d_);
    tree_.weight.push_back(weight);
  }

  /// With the levels above the boxes.
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

/// The boxes of a rim, each with the spacing of its seeds in the place of the weight.
PackedTree tree_of(const Rim& rim, int dimension) {
  TreeOfBoxes boxes(dimension);
  const auto d = static_cast<std::size_t>(dimension);
  for (std::size_t k = 0; k < rim.leaves(); ++k)
    boxes.add(box_around(&rim.seed[k * PackedTree::fan * d], PackedTree::fan, d).view(), rim.spacing[k]);
  return std::move(boxes).finish();
}

class Rest {
 public:
  Rest(const SeedSet& seeds, const PackedTree& tree, const Rim& rim, std::span<const std::uint32_t> sent)
      : seeds_(seeds), tree_(tree), rim_(tree_of(rim, tree.dimension)), sent_(sent), boxes_(tree.dimension) {}

  /// Adds the boxes below a node of a level.
  void add(std::uint32_t node, std::uint32_t level) {
    const std::size_t size = std::size_t{PackedTree::fan} << (3 * level), first = node * size,
                      last = std::min(first + size, seeds_.size());
    const auto from = std::lower_bound(sent_.begin(), sent_.end(), first),
               to = std::lower_bound(from, sent_.end(), last);
    const auto sent = static_cast<std::size_t>(to - from);
    const std::uint32_t number = tree_.level_offset[level] + node;
    if (sent == last - first) return;
    if (level > 0 && (sent > 0 || is_near_rim(number)))
      Walk(tree_).for_children({node, level, 0}, [&](std::uint32_t child) { add(child, level - 1); });
    else if (sent > 0)
      add_rest_of_leaf(first, last);
    else
      boxes_.add(box_of(tree_, number), tree_.weight[number]);
  }
  PackedTree finish() && { return std::move(boxes_).finish(); }

 private:
  bool is_near_rim(std::uint32_t number) const {
    const BoxView box = box_of(tree_, number);
    return has_open_leaf(rim_, [&](std::uint32_t leaf) {
      const double spacing = rim_.weight[leaf];
      return gap2(box, box_of(rim_, leaf), static_cast<std::size_t>(tree_.dimension)) <= spacing * spacing;
    });
  }

  void add_rest_of_leaf(std::size_t first, std::size_t last) {
    const auto d = static_cast<std::size_t>(tree_.dimension);
    std::vector<double> left;
    double heaviest = 0;
    for (std::size_t rank = first; rank < last; ++rank) {
      if (std::binary_search(sent_.begin(), sent_.end(), rank)) continue;
      heaviest = left.empty() ? seeds_.weights[rank] : std::max(heaviest, seeds_.weights[rank]);
      left.insert(left.end(), &seeds_.positions[rank * d], &seeds_.positions[rank * d] + d);
    }
    boxes_.add(box_around(left.data(), left.size() / d, d).view(), heaviest);
  }

  const SeedSet& seeds_;
  const PackedTree& tree_;
  const PackedTree rim_;
  std::span<const std::uint32_t> sent_;
  TreeOfBoxes boxes_;
};

}  // namespace

PackedTree outline_of_rest(const SeedSet& seeds, const PackedTree& tree, std::size_t level, const Rim& rim,
                           std::span<const std::uint32_t> sent) {
  Rest rest(seeds, tree, rim, sent);
  for (std::uint32_t node = 0; node < tree.level_offset[level + 1] - tree.level_offset[level]; ++node)
    rest.add(node, static_cast<std::uint32_t>(level));
  return std::move(rest).finish();
}

}  // namespace powercell::exchange
