/// \file
/// Boxes around seeds, and their distances.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/exchange/cut_test.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::exchange {

/// A box whose coordinates are elsewhere.
struct BoxView {
  const double *low, *high;
};

inline BoxView box_of(const PackedTree& tree, std::uint32_t number) {
  const auto d = static_cast<std::size_t>(tree.dimension);
  return {&tree.low[number * d], &tree.high[number * d]};
}

struct Box {
  std::array<double, 3> low{}, high{};
  BoxView view() const { return {low.data(), high.data()}; }
};

/// The smallest box around `count` points, whose coordinates follow each other.
inline Box box_around(const double* point, std::size_t count, std::size_t d) {
  Box box;
  for (std::size_t k = 0; k < d; ++k) {
    box.low[k] = box.high[k] = point[k];
    for (std::size_t a = 1; a < count; ++a) {
      box.low[k] = std::min(box.low[k], point[a * d + k]);
      box.high[k] = std::max(box.high[k], point[a * d + k]);
    }
  }
  return box;
}

/// Extends a box so that it contains another one.
inline void extend(Box& box, const BoxView& by, std::size_t d) {
  for (std::size_t k = 0; k < d; ++k) {
    box.low[k] = std::min(box.low[k], by.low[k]);
    box.high[k] = std::max(box.high[k], by.high[k]);
  }
}

inline double longest_edge(const BoxView& box, std::size_t d) {
  double edge = 0;
  for (std::size_t k = 0; k < d; ++k) edge = std::max(edge, box.high[k] - box.low[k]);
  return edge;
}

/// The square of the distance between two boxes.
inline double gap2(const BoxView& a, const BoxView& b, std::size_t d) {
  return sum_along(d, [&](std::size_t k) {
    const double gap = std::max(std::max(a.low[k] - b.high[k], b.low[k] - a.high[k]), 0.0);
    return gap * gap;
  });
}

}  // namespace powercell::exchange
