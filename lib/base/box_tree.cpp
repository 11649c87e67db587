#include "lib/base/box_tree.hpp"

#include <cmath>

#include "lib/base/radix_sort.hpp"

namespace powercell {
namespace {

constexpr unsigned axis_bits = 21;

/// The lowest 21 bits of x, two zeros between each two.
std::uint64_t spread(std::uint64_t x) {
  x &= (std::uint64_t{1} << axis_bits) - 1;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

std::vector<KeyedIndex> morton_order(std::span<const Box> boxes) {
  Box all;
  for (const Box& box : boxes) all.add(box);
  std::vector<KeyedIndex> order(boxes.size()), scratch(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    std::uint64_t key = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double extent = all.high[k] - all.low[k];
      const double middle = boxes[i].low[k] / 2 + boxes[i].high[k] / 2;
      const double share = extent > 0 ? std::clamp((middle - all.low[k]) / extent, 0.0, 1.0) : 0;
      key |= spread(static_cast<std::uint64_t>(share * 0x1fffff)) << (k + 1);
    }
    order[i] = {key, i};
  }
  sort_by_key(order, scratch, 1);
  return order;
}

}  // namespace

BoxGrid::BoxGrid(std::span<const Box> boxes) {
  constexpr double most_cells = 1 << 18;
  for (const Box& box : boxes) all_.add(box);
  int axes = 0;
  for (std::size_t k = 0; k < 3; ++k) axes += all_.high[k] > all_.low[k];
  std::size_t count = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = all_.high[k] - all_.low[k];
    if (extent > 0) {
      last_[k] = std::floor(std::pow(most_cells, 1.0 / axes)) - 1;
      scale_[k] = (last_[k] + 1) / extent;
    }
    stride_[k] = count;
    count *= static_cast<std::size_t>(last_[k]) + 1;
  }
  taken_.assign(count, 0);
  for (const Box& box : boxes) {
    std::array<std::uint32_t, 3> first{}, last{};
    cells(box, first, last);
    for (std::size_t z = first[2]; z <= last[2]; ++z)
      for (std::size_t y = first[1]; y <= last[1]; ++y)
        for (std::size_t x = first[0]; x <= last[0]; ++x) taken_[x + y * stride_[1] + z * stride_[2]] = 1;
  }
}

bool BoxGrid::any(const std::array<std::uint32_t, 3>& first, const std::array<std::uint32_t, 3>& last) const {
  for (std::size_t z = first[2]; z <= last[2]; ++z)
    for (std::size_t y = first[1]; y <= last[1]; ++y)
      for (std::size_t x = first[0]; x <= last[0]; ++x)
        if (taken_[x + y * stride_[1] + z * stride_[2]] != 0) return true;
  return false;
}

BoxTree::BoxTree(std::span<const Box> boxes) {
  if (boxes.empty()) return;
  level_.emplace_back();
  for (const KeyedIndex& at : morton_order(boxes)) {
    index_.push_back(at.index);
    level_[0].push_back(boxes[at.index]);
  }
  while (level_.back().size() > fan) {
    const std::vector<Box>& below = level_.back();
    std::vector<Box> above((below.size() + fan - 1) / fan);
    for (std::size_t k = 0; k < below.size(); ++k) above[k / fan].add(below[k]);
    level_.push_back(std::move(above));
  }
}

}  // namespace powercell
