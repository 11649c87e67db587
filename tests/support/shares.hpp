/// \file
/// Seeds shared out to shards.
#pragma once

#include "lib/exchange/sharded.hpp"
#include "lib/seeds/hilbert.hpp"
#include "tests/support/generators.hpp"

namespace powercell::test {

/// Seeds shared out: seed i of all, which is its id, is in the shard of its number.
struct Shares {
  int dimension;
  std::vector<std::vector<std::uint64_t>> ids;
  std::vector<std::vector<double>> positions, weights;

  Shares(const SeedArray& seeds, const std::vector<std::size_t>& shard, std::size_t count)
      : dimension(seeds.dimension), ids(count), positions(count), weights(count) {
    const auto d = static_cast<std::size_t>(dimension);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      ids[shard[i]].push_back(i);
      for (std::size_t k = 0; k < d; ++k) positions[shard[i]].push_back(seeds.positions[i * d + k]);
      weights[shard[i]].push_back(seeds.weights[i]);
    }
  }
  /// Valid as long as this.
  std::vector<exchange::ShardSeeds> view() const {
    std::vector<exchange::ShardSeeds> shards;
    for (std::size_t s = 0; s < ids.size(); ++s)
      shards.push_back({ids[s], {dimension, positions[s], weights[s]}});
    return shards;
  }
};

/// Shards of equal size along a Hilbert curve.
inline Shares along_curve(const SeedArray& seeds, std::size_t count) {
  std::vector<std::size_t> shard(seeds.size());
  const std::vector<std::uint32_t> order = hilbert_order(seeds.positions, seeds.dimension, 1);
  for (std::size_t k = 0; k < order.size(); ++k) shard[order[k]] = k * count / order.size();
  return {seeds, shard, count};
}

}  // namespace powercell::test
