/// \file
/// Search for the boxes that meet a box.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace powercell {

/// An axis-aligned box, closed; empty until a point is added.
struct Box {
  std::array<double, 3> low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  void add(const double* point) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
  void add(const Box& box) {
    add(box.low.data());
    add(box.high.data());
  }
  bool meets(const Box& box) const {
    bool apart = false;
    for (std::size_t k = 0; k < 3; ++k) apart |= low[k] > box.high[k] || box.low[k] > high[k];
    return !apart;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
};

/// A grid over boxes that knows which of its cells they meet.
class BoxGrid {
 public:
  explicit BoxGrid(std::span<const Box> boxes);

  /// False only if no box meets `box`; some boxes that meet none are taken for true.
  bool may_meet(const Box& box) const {
    if (!all_.meets(box)) return false;
    std::array<std::uint32_t, 3> first{}, last{};
    cells(box, first, last);
    std::uint32_t count = 1;
    for (std::size_t k = 0; k < 3; ++k) count *= last[k] - first[k] + 1;
    return count > most_looked_up || any(first, last);
  }

 private:
  static constexpr std::uint32_t most_looked_up = 64;

  void cells(const Box& box, std::array<std::uint32_t, 3>& first, std::array<std::uint32_t, 3>& last) const {
    for (std::size_t k = 0; k < 3; ++k) {
      first[k] = cell(box.low[k], k);
      last[k] = cell(box.high[k], k);
    }
  }
  std::uint32_t cell(double x, std::size_t axis) const {
    return static_cast<std::uint32_t>(std::clamp((x - all_.low[axis]) * scale_[axis], 0.0, last_[axis]));
  }
  bool any(const std::array<std::uint32_t, 3>& first, const std::array<std::uint32_t, 3>& last) const;

  Box all_;
  std::array<double, 3> scale_{}, last_{};  // cells a unit of length; the last cell
  std::array<std::size_t, 3> stride_{};
  std::vector<char> taken_;
};

/// Boxes sorted along a Morton curve, with the boxes of each eight of them, of each eight of those, and so
/// on.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes);

  /// Calls `visit(index)` for each box that meets `box`.
  template <class Visit>
  void for_each_meeting(const Box& box, const Visit& visit) const {
    if (!level_.empty()) descend(level_.size() - 1, 0, box, visit);
  }

 private:
  static constexpr std::size_t fan = 8;

  template <class Visit>
  void descend(std::size_t level, std::size_t group, const Box& box, const Visit& visit) const {
    const std::vector<Box>& boxes = level_[level];
    for (std::size_t k = fan * group; k < std::min(boxes.size(), fan * (group + 1)); ++k) {
      if (!boxes[k].meets(box)) continue;
      if (level == 0)
        visit(index_[k]);
      else
        descend(level - 1, k, box, visit);
    }
  }

  std::vector<std::uint32_t> index_;     // of the caller's boxes, sorted
  std::vector<std::vector<Box>> level_;  // level 0: the boxes, sorted; the last has at most `fan`
};

}  // namespace powercell
