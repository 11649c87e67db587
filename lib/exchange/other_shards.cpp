#include "lib/exchange/other_shards.hpp"

#include <algorithm>

namespace powercell::exchange {
namespace {

/// Whether seeds in a node could cut a cell.
bool cell_may_meet(const PackedTree& boxes, std::uint32_t node, const CutTest& cell) {
  const BoxView box = box_of(boxes, node);
  return cell.may_meet(box.low, box.high, boxes.weight[node]);
}

}  // namespace

FirstCoarseTrees::FirstCoarseTrees(std::vector<PackedTree> coarse_tree, int dimension)
    : coarse_tree_(std::move(coarse_tree)) {
  TreeOfBoxes boxes(dimension);
  for (std::size_t shard = 0; shard < coarse_tree_.size(); ++shard) {
    const PackedTree& tree = coarse_tree_[shard];
    if (tree.levels() == 0) continue;
    const std::uint32_t root = tree.level_offset[tree.levels() - 1];
    boxes.add(box_of(tree, root), tree.weight[root]);
    shard_.push_back(static_cast<int>(shard));
  }
  tree_ = std::move(boxes).finish();
}

template <class Open>
bool NearBoxes::has_box(const Open& open) const {
  bool found = false;
  others_.visit(open, [&](int shard) {
    const PackedTree& boxes = others_.unsent_of(shard);
    found = has_open_leaf(boxes, [&](std::uint32_t node) { return open(boxes, node); });
    return !found;
  });
  return found;
}

bool NearBoxes::may_meet(const BoxView& box, const CutTest& farthest) const {
  return has_box([&](const PackedTree& boxes, std::uint32_t node) {
    return farthest.may_meet(gap2(box, box_of(boxes, node), static_cast<std::size_t>(boxes.dimension)),
                             boxes.weight[node]);
  });
}

bool NearBoxes::may_meet(const double* seed, double radius) const {
  const auto d = static_cast<std::size_t>(others_.dimension());
  return std::any_of(moves_.begin(), moves_.end(), [&](const Point& move) {
    const CutTest cell(moved(seed, move, d).data(), radius, others_.dimension());
    return has_box(
        [&](const PackedTree& boxes, std::uint32_t node) { return cell_may_meet(boxes, node, cell); });
  });
}

void NearBoxes::set(const double* seed, double radius) {
  const auto d = static_cast<std::size_t>(others_.dimension());
  std::copy_n(seed, d + 1, seed_.begin());
  groups_.clear();
  box_.clear();
  complete_ = true;
  for (std::size_t m = 0; m < moves_.size(); ++m) {
    const CutTest cell(moved(seed, moves_[m], d).data(), radius, others_.dimension());
    const auto open = [&](const PackedTree& boxes, std::uint32_t node) {
      return cell_may_meet(boxes, node, cell);
    };
    others_.visit(open, [&](int shard) {
      const PackedTree& boxes = others_.unsent_of(shard);
      const std::size_t before = box_.size();
      visit_leaves(
          boxes, [&](std::uint32_t node) { return open(boxes, node); },
          [&](std::uint32_t node) {
            box_.push_back(node);
            complete_ = complete_ && box_.size() <= most_boxes;
            return complete_;
          });
      if (box_.size() > before) groups_.push_back({{shard, m}, cell, box_.size()});
      return true;
    });
  }
}

void NearBoxes::views_at(const Point& y, std::vector<View>& views) {
  views.clear();
  std::size_t begin = 0;
  for (Group& group : groups_) {
    const PackedTree& boxes = others_.unsent_of(group.view.shard);
    const auto first = box_.begin() + static_cast<std::ptrdiff_t>(std::exchange(begin, group.end)),
               last = box_.begin() + static_cast<std::ptrdiff_t>(group.end);
    group.cell.move_to(y);
    const auto may_cut_it = [&](std::uint32_t node) { return node_may_cut(boxes, node, group.cell); };
    if (complete_ ? std::any_of(first, last, may_cut_it) : may_cut(boxes, group.cell))
      views.push_back(group.view);
  }
}

bool NearBoxes::may_cut_at(const View& view, const Point& y) {
  const auto group = std::find_if(groups_.begin(), groups_.end(),
                                  [&](const Group& candidate) { return candidate.view == view; });
  group->cell.move_to(y);
  return may_cut(others_.unsent_of(view.shard), group->cell);
}

std::array<double, 4> NearBoxes::row(const View& view) const {
  return moved(seed_.data(), moves_[view.move], static_cast<std::size_t>(others_.dimension()));
}

}  // namespace powercell::exchange
