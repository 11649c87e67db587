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

FirstOutlines::FirstOutlines(std::vector<PackedTree> outline, int dimension) : outline_(std::move(outline)) {
  TreeOfBoxes boxes(dimension);
  for (std::size_t shard = 0; shard < outline_.size(); ++shard) {
    const PackedTree& tree = outline_[shard];
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
    const PackedTree& boxes = others_.rest_of(shard);
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

bool NearBoxes::may_meet(const CutTest& cell) const {
  return has_box(
      [&](const PackedTree& boxes, std::uint32_t node) { return cell_may_meet(boxes, node, cell); });
}

void NearBoxes::set(const CutTest& cell) {
  shards_.clear();
  end_.clear();
  box_.clear();
  complete_ = true;
  const auto open = [&](const PackedTree& boxes, std::uint32_t node) {
    return cell_may_meet(boxes, node, cell);
  };
  others_.visit(open, [&](int shard) {
    const PackedTree& boxes = others_.rest_of(shard);
    const std::size_t before = box_.size();
    visit_leaves(
        boxes, [&](std::uint32_t node) { return open(boxes, node); },
        [&](std::uint32_t node) {
          box_.push_back(node);
          complete_ = complete_ && box_.size() <= most_boxes;
          return complete_;
        });
    if (box_.size() > before) {
      shards_.push_back(shard);
      end_.push_back(box_.size());
    }
    return true;
  });
}

void NearBoxes::shards_at(const CutTest& point, std::vector<int>& shards) const {
  shards.clear();
  for (std::size_t s = 0; s < shards_.size(); ++s) {
    const PackedTree& boxes = others_.rest_of(shards_[s]);
    const auto first = box_.begin() + static_cast<std::ptrdiff_t>(s == 0 ? 0 : end_[s - 1]),
               last = box_.begin() + static_cast<std::ptrdiff_t>(end_[s]);
    if (complete_
            ? std::any_of(first, last, [&](std::uint32_t node) { return node_may_cut(boxes, node, point); })
            : may_cut(boxes, point))
      shards.push_back(shards_[s]);
  }
}

}  // namespace powercell::exchange
