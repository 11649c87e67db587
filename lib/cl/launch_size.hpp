/// \file
/// How many work-items of a kernel are launched at a time. Internal.
#pragma once

#include <algorithm>
#include <cstddef>

namespace powercell::cl {

/// A GPU that draws a screen shows nothing during a launch, and its system ends one that takes seconds. How
/// long an item takes differs by more than a thousand between devices and precisions, so it is measured.
class LaunchSize {
 public:
  static constexpr std::size_t least = 1024;  ///< with fewer, most of any GPU has nothing to do
  static constexpr double wanted_seconds = .05;

  /// \param first  items of the first launch
  explicit LaunchSize(std::size_t first) : items_(std::max(first, least)) {}

  std::size_t items() const { return items_; }

  /// What a launch of at most items() took.
  void took(std::size_t items, double seconds) {
    constexpr double most_growth = 4;  // the first items may be cheaper than others
    // A few items take as long as many that run beside each other: they tell nothing where that is short.
    if (items < items_ && !(seconds > wanted_seconds)) return;
    const double factor = seconds > 0 ? std::min(wanted_seconds / seconds, most_growth) : most_growth;
    const double next = static_cast<double>(items) * factor;
    items_ = std::max(next < most_items ? static_cast<std::size_t>(next) : most, least);
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 30;
  static constexpr double most_items = most;

  std::size_t items_;
};

}  // namespace powercell::cl
