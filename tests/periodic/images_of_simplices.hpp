/// \file
/// Simplices of periodic triangulations, which translations make of one another.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace powercell::test {

/// Corners: a seed and its image, in periods.
using PeriodicSimplex = std::vector<std::pair<std::uint32_t, std::array<std::int32_t, 3>>>;

/// The first, in order, of the images of a simplex in which some corner has the shift 0.
inline PeriodicSimplex first_image(const PeriodicSimplex& simplex) {
  std::set<PeriodicSimplex> images;
  for (const auto& [origin, by] : simplex) {
    PeriodicSimplex image = simplex;
    for (auto& [seed, shift] : image)
      for (std::size_t k = 0; k < 3; ++k) shift[k] -= by[k];
    std::sort(image.begin(), image.end());
    images.insert(image);
  }
  return *images.begin();
}

}  // namespace powercell::test
