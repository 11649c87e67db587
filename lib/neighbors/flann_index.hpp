/// \file
/// Nearest lifted seeds by FLANN's KDTreeSingleIndex. Only flann.cpp includes FLANN.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

class FlannIndex {
 public:
  /// \param scale    power of two that brings the squares of positions into range
  /// \param heights  the lift h_i of (5) by rank, scaled
  FlannIndex(const SeedSet& seeds, double scale, std::span<const double> heights);
  ~FlannIndex();

  /// Finds for each rank the `count` lifted seeds nearest to its query point, the twin (p, -h) or the lifted
  /// seed (p, h) itself, without the seed, nearest first.
  /// \param rows  set to rows of `count` ranks
  /// \pre count < number of seeds
  void query(std::span<const std::uint32_t> ranks, std::size_t count, bool twins, int threads,
             std::vector<std::uint32_t>& rows) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace powercell
