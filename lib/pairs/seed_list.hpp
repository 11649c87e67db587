/// \file
/// The few seeds in question for a box or region, column by column for vector units. Internal.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lib/seeds/seed_set.hpp"

namespace powercell::pairs {

/// Columns 0 .. D-1 are coordinates, column D is the weight.
template <int D>
using SeedColumns = std::array<std::vector<double>, D + 1>;

/// Seeds by ascending rank, with coordinates as given and weights relative to a reference.
template <int D>
struct SeedList {
  std::vector<std::uint32_t> rank;
  SeedColumns<D> column;

  std::size_t size() const { return rank.size(); }
  void clear() {
    rank.clear();
    for (std::vector<double>& c : column) c.clear();
  }
  void add(const SeedSet& seeds, std::uint32_t r, double reference) {
    rank.push_back(r);
    for (std::size_t k = 0; k < D; ++k) column[k].push_back(seeds.positions[std::size_t{r} * D + k]);
    column[D].push_back(seeds.weights[r] - reference);
  }
  /// Becomes the seeds of `from` at these places.
  void pick(const SeedList& from, const std::vector<std::uint32_t>& place) {
    const std::size_t count = place.size();
    rank.resize(count);
    for (std::size_t s = 0; s < count; ++s) rank[s] = from.rank[place[s]];
    for (std::size_t k = 0; k <= D; ++k) {
      column[k].resize(count);
      for (std::size_t s = 0; s < count; ++s) column[k][s] = from.column[k][place[s]];
    }
  }
};

}  // namespace powercell::pairs
