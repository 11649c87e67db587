/// \file
/// Collects the walls of the cells of a periodic domain into the symmetric adjacency. Internal.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/clip/pieces.hpp"
#include "lib/periodic/images.hpp"

namespace powercell {

class PeriodicWalls {
 public:
  /// Keeps the reference.
  explicit PeriodicWalls(const Placement& placement);

  /// Adds the pieces of a chunk, one for each rank. Ranks ascend over all chunks.
  void add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);

  /// As WallCollector::finish.
  Adjacency finish(const std::vector<SeedStatus>& status, double unit, double negligible, int threads);

 private:
  /// A wall as seen from the cell of the row that it is in.
  struct Wall {
    std::uint32_t neighbor;  // input index
    Shift shift;
    double measure;
    bool two_sided;
    /// Of the same neighbour and image.
    bool matches(const Wall& other) const { return neighbor == other.neighbor && shift == other.shift; }
    bool operator<(const Wall& other) const {
      return neighbor != other.neighbor ? neighbor < other.neighbor : shift < other.shift;
    }
  };
  struct Difference {
    double value = 0;
    std::uint32_t from = 0, to = 0;  // input indices
  };

  std::span<Wall> row(std::uint32_t i) { return std::span(wall_).subspan(first_[i], count_[i]); }
  void sort_rows(int threads);
  Wall* other_side(std::uint32_t i, const Wall& wall);
  Difference match(std::uint32_t i);
  /// Adds the missing sides of walls that one cell alone has, or removes them as rounding.
  void settle_one_sided(const std::vector<SeedStatus>& status, double negligible, Difference& worst);

  const Placement& placement_;
  std::vector<Wall> wall_;
  std::vector<std::uint64_t> first_;  // by input index
  std::vector<std::uint32_t> count_;
};

}  // namespace powercell
