/// \file
/// Nearest lifted neighbours through FLANN's KDTreeSingleIndex; the only user of FLANN is flann.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

class FlannIndex {
 public:
  /// \param scale    a power of two that positions are multiplied by, so that their squares are in range
  /// \param heights  the lift h_i by rank, as many as seeds, in the unit that `scale` makes
  FlannIndex(const SeedSet& seeds, double scale, std::span<const double> heights);
  ~FlannIndex();

  /// For each rank the `count` nearest other seeds by lifted distance from its query point (the twin
  /// (p, -h) or the lifted seed (p, h)), nearest first: rows of `count` ranks. count <= seeds - 1.
  void query(std::span<const std::uint32_t> ranks, std::size_t count, bool twins, int threads,
             std::vector<std::uint32_t>& rows) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace powercell
