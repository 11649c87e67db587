/// \file
/// Gathers the walls of clipped pieces into the symmetric adjacency.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/clip/pieces.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

class WallCollector {
 public:
  WallCollector(std::size_t ranks, int threads);

  /// Adds the pieces of a chunk; ranks ascend over the chunks, and one rank may go on in the next chunk.
  void add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);

  /// The adjacency in input order between seeds whose status is ok, walls times `unit`. The two sides of
  /// a wall are averaged. A wall that only one side has is rounding if it is below `negligible` of the
  /// largest wall of its cell, and left out; above, it is kept and shows in Adjacency::asymmetry.
  Adjacency finish(const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                   double negligible);

 private:
  struct Wall {
    std::uint32_t neighbor;  // rank
    double measure;
  };
  struct Entry {
    std::uint32_t a, b;  // input indices, by rank a before b
    double measure;
  };
  static void merge(std::vector<Wall>& row);
  std::span<const Wall> row(std::uint32_t rank) const;
  std::vector<Entry> match(const SeedSet& seeds, const std::vector<SeedStatus>& status, double negligible,
                           double& asymmetry) const;

  int threads_;
  std::vector<std::uint64_t> end_;  // by rank: end of its row in walls_
  std::vector<Wall> walls_;
  std::uint32_t open_ = 0;  // the rank whose row ends walls_
};

}  // namespace powercell
