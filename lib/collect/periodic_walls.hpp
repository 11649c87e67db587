/// \file
/// Collects the walls of the cells of a periodic domain into the symmetric adjacency.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/base/memory.hpp"
#include "lib/cell/pieces.hpp"
#include "lib/periodic/images.hpp"

namespace powercell {

class PeriodicWalls {
 public:
  /// Keeps the reference.
  PeriodicWalls(const Placement& placement, int threads);

  /// Adds the pieces of a chunk, one for each rank. Ranks ascend over all chunks.
  void add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);

  /// As WallCollector::finish. To be called once.
  Adjacency finish(const std::vector<SeedStatus>& status, double unit, double negligible);

 private:
  struct Difference {
    double value = 0;
    std::uint32_t from = 0, to = 0;  // ranks
  };
  /// A wall in its final order.
  struct Entry {
    std::uint32_t neighbor;  // input index
    Shift shift;
    double wall;
    bool operator<(const Entry& other) const {
      return neighbor != other.neighbor ? neighbor < other.neighbor : shift < other.shift;
    }
  };
  /// A wall of a cell that its neighbour does not have, as that neighbour's.
  struct Missing {
    std::uint32_t rank;
    Entry entry;
  };

  /// The places of the walls of a rank in the arrays.
  std::uint64_t begin_of(std::uint32_t rank) const { return first_[rank]; }
  std::uint64_t end_of(std::uint32_t rank) const { return first_[rank] + count_[rank]; }
  void fill_row(std::uint32_t rank, const PieceBatch& batch, std::uint32_t row);
  std::uint64_t other_side(std::uint32_t rank, std::uint64_t wall) const;
  Difference match(std::uint32_t rank);
  /// Sets walls to 0 that one cell alone has as rounding, and lists the missing sides of the others.
  std::vector<Missing> settle_one_sided(double negligible, Difference& worst);
  std::uint64_t kept_walls(std::uint32_t rank) const;
  void write_row(std::uint32_t rank, std::span<const Missing> missing, double unit, Adjacency& out) const;
  bool has_shifts(std::uint32_t rank) const;
  template <class Body>
  void for_ranks(const Body& body) const;

  const Placement& placement_;
  int threads_;
  GrowingArray<std::uint32_t> neighbors_;  // by wall: its rank, of a seed or an image
  GrowingArray<double> measures_;          // by wall: below 0 if both cells have it
  std::vector<std::uint64_t> first_;       // by rank of a seed: its first wall
  std::vector<std::uint32_t> count_;       // by rank of a seed
  std::vector<std::uint8_t> ok_;           // by rank of a seed: it has a cell
  std::vector<std::uint8_t> is_moved_;     // by rank of a seed: it was wrapped to another place
};

}  // namespace powercell
