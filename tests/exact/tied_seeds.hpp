/// \file
/// Few seeds with many ties, and comparisons of their diagrams.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <powercell/diagram.hpp>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

namespace powercell::test {

/// At most n seeds with distinct positions in multiples of 1/8 and weights of 1/64, so that power distances
/// are exact and ties frequent.
/// \param middle  of the positions along each axis
/// \param moved   whether half of the numbers are moved by a few units in the last place
inline SeedArray tied_seeds(std::size_t n, double middle, int dimension, bool moved, Random& random) {
  SeedArray seeds{dimension, {}, {}};
  const auto little = [&] {
    return moved && random.index(2) == 0 ? 0x1p-55 * (static_cast<double>(random.index(17)) - 8) : 0.0;
  };
  const bool weighted = random.index(2) == 0;
  std::set<std::vector<double>> places;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> place;
    for (int k = 0; k < dimension; ++k)
      place.push_back(middle + (static_cast<double>(random.index(13)) - 6) / 8 + little());
    if (!places.insert(place).second) continue;
    seeds.positions.insert(seeds.positions.end(), place.begin(), place.end());
    seeds.weights.push_back((weighted ? static_cast<double>(random.index(9)) / 64 : 0) + little());
  }
  return seeds;
}

/// The results that do not depend on how the domain is cut into regions.
struct Outcome {
  Measures measures;
  std::map<std::pair<std::size_t, std::size_t>, double> walls;
  std::set<std::vector<std::uint32_t>> simplices;
};

inline Outcome outcome_of(const Setup& setup, const Domain& domain, const SeedsView& seeds) {
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds);
  Outcome result{diagram.measures(), {}, {}};
  const Adjacency& adjacency = diagram.adjacency();
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (std::uint64_t k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k)
      result.walls[{i, adjacency.neighbor[k]}] = adjacency.wall[k];
  const Dual& dual = diagram.dual();
  const auto corners = static_cast<std::ptrdiff_t>(dual.corners);
  for (auto at = dual.simplices.begin(); at != dual.simplices.end(); at += corners) {
    std::vector<std::uint32_t> simplex(at, at + corners);
    std::ranges::sort(simplex);
    result.simplices.insert(simplex);
  }
  return result;
}

inline void expect_same_cells(const Outcome& one, const Outcome& other, double tolerance) {
  CHECK(one.measures.status == other.measures.status);
  for (std::size_t i = 0; i < one.measures.mass.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(one.measures.mass[i] - other.measures.mass[i]) <= tolerance);
  }
}

inline void expect_same(const Outcome& one, const Outcome& other, double tolerance) {
  expect_same_cells(one, other, tolerance);
  for (const Outcome* a : {&one, &other}) {
    const Outcome* b = a == &one ? &other : &one;
    for (const auto& entry : a->walls) {
      const auto found = b->walls.find(entry.first);
      CAPTURE(entry.first.first);
      CAPTURE(entry.first.second);
      CAPTURE((a == &one));
      CHECK(std::abs(entry.second - (found == b->walls.end() ? 0 : found->second)) <= tolerance);
    }
  }
}

}  // namespace powercell::test
