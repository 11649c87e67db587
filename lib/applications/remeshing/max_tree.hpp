/// \file
/// A priority queue whose entries change in place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace powercell::remeshing {

/// The largest of n values that change: a tournament tree, O(log n) per change.
class MaxTree {
 public:
  void set(std::uint32_t i, double value) {
    if (i >= leaves_) grow(i + 1);
    std::size_t node = leaves_ + i;
    value_[node] = value;
    for (node /= 2; node > 0; node /= 2) value_[node] = std::max(value_[2 * node], value_[2 * node + 1]);
  }
  double top() const { return leaves_ == 0 ? lowest : value_[1]; }
  /// An entry with that value.
  /// \pre an entry was set
  std::uint32_t top_index() const {
    std::size_t node = 1;
    while (node < leaves_) node = value_[2 * node] >= value_[2 * node + 1] ? 2 * node : 2 * node + 1;
    return static_cast<std::uint32_t>(node - leaves_);
  }
  static constexpr double lowest = -1e300;

 private:
  void grow(std::size_t count) {
    std::vector<double> old(value_.begin() + static_cast<std::ptrdiff_t>(leaves_), value_.end());
    leaves_ = std::max<std::size_t>(leaves_, 1);
    while (leaves_ < count) leaves_ *= 2;
    value_.assign(2 * leaves_, lowest);
    std::copy(old.begin(), old.end(), value_.begin() + static_cast<std::ptrdiff_t>(leaves_));
    for (std::size_t node = leaves_ - 1; node > 0; --node)
      value_[node] = std::max(value_[2 * node], value_[2 * node + 1]);
  }
  std::size_t leaves_ = 0;
  std::vector<double> value_;
};

}  // namespace powercell::remeshing
