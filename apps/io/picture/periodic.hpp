/// \file
/// Images of cells and seeds in pictures of periodic domains.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <powercell/domain.hpp>
#include <vector>

namespace powercell::io {

using Translation = std::array<double, 2>;

struct FlatBox {
  std::array<double, 2> low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  std::array<double, 2> high{-std::numeric_limits<double>::infinity(),
                             -std::numeric_limits<double>::infinity()};
  void add(const double* point) {
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], point[k]);
      high[k] = std::max(high[k], point[k]);
    }
  }
};

/// The periods, and their sums with whole factors, that bring the box to overlap that of the domain with the
/// margin of a picture. Only
/// zero in a domain that is not periodic, whether they overlap or not.
std::vector<Translation> translations_into_view(const Domain& domain, const FlatBox& box);

}  // namespace powercell::io
