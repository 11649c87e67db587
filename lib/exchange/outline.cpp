#include "lib/exchange/outline.hpp"

#include <algorithm>

#include "lib/exchange/messages.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {

std::size_t outline_level(const PackedTree& tree, std::size_t most_nodes) {
  std::size_t level = 0;
  while (level + 1 < tree.levels() && tree.level_offset[level + 1] - tree.level_offset[level] > most_nodes)
    ++level;
  return level;
}

PackedTree outline_of(const PackedTree& tree, std::size_t most_nodes) {
  PackedTree top;
  top.dimension = tree.dimension;
  if (tree.levels() == 0) return top;
  const std::size_t lowest = outline_level(tree, most_nodes);
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

std::size_t outline_bytes(const PackedTree& outline) {
  return bytes_of(outline.level_offset) + bytes_of(outline.low) + bytes_of(outline.high) +
         bytes_of(outline.weight);
}

namespace {

/// Whether seeds in a node could cut off a point.
bool node_may_cut(const PackedTree& outline, std::uint32_t node, const CutTest& point) {
  const auto d = static_cast<std::size_t>(outline.dimension);
  return !(point.power(&outline.low[node * d], &outline.high[node * d], outline.weight[node]) >
           point.limit());
}

}  // namespace

bool may_cut(const PackedTree& outline, const CutTest& point) {
  return has_open_leaf(outline, [&](std::uint32_t node) { return node_may_cut(outline, node, point); });
}

bool NearBoxes::may_meet(const BoxView& box, const CutTest& farthest) const {
  for (int shard = 0; shard < static_cast<int>(others_.outlines->size()); ++shard) {
    if (shard == self_) continue;
    const PackedTree& boxes = outline(shard);
    const auto d = static_cast<std::size_t>(boxes.dimension);
    if (has_open_leaf(boxes, [&](std::uint32_t node) {
          return farthest.may_meet(gap2(box, box_of(boxes, node), d), boxes.weight[node]);
        }))
      return true;
  }
  return false;
}

void NearBoxes::set(const CutTest& cell) {
  shards_.clear();
  end_.clear();
  box_.clear();
  complete_ = true;
  for (int shard = 0; shard < static_cast<int>(others_.outlines->size()); ++shard) {
    if (shard == self_) continue;
    const PackedTree& boxes = outline(shard);
    const auto d = static_cast<std::size_t>(boxes.dimension);
    const std::size_t before = box_.size();
    visit_leaves(
        boxes,
        [&](std::uint32_t node) {
          return cell.may_meet(&boxes.low[node * d], &boxes.high[node * d], boxes.weight[node]);
        },
        [&](std::uint32_t node) {
          box_.push_back(node);
          complete_ = complete_ && box_.size() <= most_boxes;
          return complete_;
        });
    if (box_.size() == before) continue;
    shards_.push_back(shard);
    end_.push_back(box_.size());
  }
}

void NearBoxes::shards_at(const CutTest& point, std::vector<int>& shards) const {
  shards.clear();
  for (std::size_t s = 0; s < shards_.size(); ++s) {
    const PackedTree& boxes = outline(shards_[s]);
    const auto first = box_.begin() + static_cast<std::ptrdiff_t>(s == 0 ? 0 : end_[s - 1]),
               last = box_.begin() + static_cast<std::ptrdiff_t>(end_[s]);
    if (complete_
            ? std::any_of(first, last, [&](std::uint32_t node) { return node_may_cut(boxes, node, point); })
            : may_cut(boxes, point))
      shards.push_back(shards_[s]);
  }
}

bool may_contain(const PackedTree& outline, const double* position) {
  return has_open_leaf(outline, [&](std::uint32_t node) { return contains(outline, node, position); });
}

}  // namespace powercell::exchange
