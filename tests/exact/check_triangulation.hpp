/// \file
/// Checks whether simplices form a triangulation.
#pragma once

#include <algorithm>
#include <array>
#include <powercell/results.hpp>
#include <vector>

#include "tests/support/generators.hpp"

namespace powercell::test {

/// d! times the signed measure of a simplex.
inline long double signed_measure(const Dual& dual, std::size_t s, const SeedArray& seeds) {
  const int d = seeds.dimension;
  long double e[3][3];
  for (int r = 0; r < d; ++r)
    for (int k = 0; k < d; ++k) {
      const auto corner = [&](int c) {
        return dual.simplices[s * static_cast<std::size_t>(d + 1) + static_cast<std::size_t>(c)];
      };
      e[r][k] = static_cast<long double>(seeds.coordinate(corner(r + 1), k)) - seeds.coordinate(corner(0), k);
    }
  if (d == 2) return e[0][0] * e[1][1] - e[0][1] * e[1][0];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

struct Triangulated {
  long double measure = 0;  ///< of the union, if there are no faults
  std::size_t faults = 0;   ///< facet_faults(), and simplices without a positive measure
};

/// The number of facets in more than two simplices, or in two on the same side.
inline std::size_t facet_faults(const Dual& dual) {
  struct Side {
    std::array<std::uint32_t, 3> facet{~0U, ~0U, ~0U};
    int sign = 1;
  };
  const auto corners = static_cast<std::size_t>(dual.corners);
  std::vector<Side> sides;
  sides.reserve(dual.simplices.size());
  for (std::size_t s = 0; s < dual.size(); ++s) {
    for (std::size_t skip = 0; skip < corners; ++skip) {
      Side side;
      side.sign = skip % 2 == 0 ? 1 : -1;
      std::size_t at = 0;
      for (std::size_t c = 0; c < corners; ++c)
        if (c != skip) side.facet[at++] = dual.simplices[s * corners + c];
      for (std::size_t a = 0; a < at; ++a)
        for (std::size_t b = a + 1; b < at; ++b)
          side.sign = side.facet[a] > side.facet[b] ? -side.sign : side.sign;
      std::sort(side.facet.begin(), side.facet.end());
      sides.push_back(side);
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.facet < b.facet; });
  std::size_t faults = 0;
  for (std::size_t k = 1; k < sides.size(); ++k) {
    if (sides[k].facet != sides[k - 1].facet) continue;
    faults += sides[k].sign == sides[k - 1].sign;
    faults += k >= 2 && sides[k].facet == sides[k - 2].facet;
  }
  return faults;
}

/// Counts the faults of a triangulation and sums the measures of its simplices.
inline Triangulated check_triangulation(const Dual& dual, const SeedArray& seeds) {
  Triangulated result{0, facet_faults(dual)};
  for (std::size_t s = 0; s < dual.size(); ++s) {
    const long double measure = signed_measure(dual, s, seeds);
    result.faults += !(measure > 0);
    result.measure += measure / (dual.corners == 3 ? 2 : 6);
  }
  return result;
}

}  // namespace powercell::test
