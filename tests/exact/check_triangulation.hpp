/// \file
/// Whether simplices are a triangulation.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
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

/// No facet is in more than two simplices, and where in two, they lie on either side of it; returns the
/// measure of their union, which is then their sum.
inline long double check_triangulation(const Dual& dual, const SeedArray& seeds) {
  const auto corners = static_cast<std::size_t>(dual.corners);
  std::map<std::vector<std::uint32_t>, std::vector<int>> facets;
  long double sum = 0;
  for (std::size_t s = 0; s < dual.size(); ++s) {
    const long double measure = signed_measure(dual, s, seeds);
    REQUIRE(measure > 0);
    sum += measure;
    for (std::size_t skip = 0; skip < corners; ++skip) {
      std::vector<std::uint32_t> facet;
      for (std::size_t c = 0; c < corners; ++c)
        if (c != skip) facet.push_back(dual.simplices[s * corners + c]);
      int sign = skip % 2 == 0 ? 1 : -1;
      for (std::size_t a = 0; a < facet.size(); ++a)
        for (std::size_t b = a + 1; b < facet.size(); ++b) sign = facet[a] > facet[b] ? -sign : sign;
      std::sort(facet.begin(), facet.end());
      facets[facet].push_back(sign);
    }
  }
  for (const auto& [facet, sides] : facets) {
    REQUIRE(sides.size() <= 2);
    if (sides.size() == 2) REQUIRE(sides[0] == -sides[1]);
  }
  return sum / (corners == 3 ? 2 : 6);
}

}  // namespace powercell::test
