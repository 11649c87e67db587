/// \file
/// Gathers the walls of clipped pieces into the symmetric adjacency.
#pragma once

#include <cstdint>
#include <cstring>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/clip/pieces.hpp"
#include "lib/seeds/memory.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The walls of one cell; memory owned elsewhere. Measures stand behind the neighbours, so that a row is one
/// piece of memory, and are at no multiple of their size.
struct WallRow {
  std::uint32_t* neighbor;  ///< ascending, none twice
  std::size_t count;

  double measure(std::size_t k) const {
    double value;
    std::memcpy(&value, neighbor + count + 2 * k, sizeof value);
    return value;
  }
  void set_measure(std::size_t k, double value) const {
    std::memcpy(neighbor + count + 2 * k, &value, sizeof value);
  }
};

/// What each cell says of its walls, by rank.
struct WallRows {
  static constexpr std::size_t words_per_wall = 3;
  std::vector<std::uint64_t> end;     ///< per rank: walls to the end of its row
  std::vector<double> largest;        ///< per rank: its largest wall, 0 if it has none
  GrowingArray<std::uint32_t> words;  ///< row after row

  std::uint64_t begin(std::uint32_t rank) const { return rank == 0 ? 0 : end[rank - 1]; }
  WallRow row(std::uint32_t rank) {
    const std::uint64_t first = begin(rank);
    return {words.data() + words_per_wall * first, static_cast<std::size_t>(end[rank] - first)};
  }
  std::uint64_t walls() const { return words.size() / words_per_wall; }
};

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
  /// A row in the making: walls in the order of the pairs.
  struct OpenRow {
    std::vector<std::uint32_t> neighbor;
    std::vector<double> measure;
    std::size_t size = 0;  // the vectors may be longer
    void add(const std::int32_t* border, const double* wall, std::size_t count);
  };
  /// The share of one thread: the ranks [first, last) with the pairs [begin, end) of the chunk.
  struct Part {
    std::size_t begin = 0, end = 0;
    std::uint32_t first = 0, last = 0;
    OpenRow open;
    std::vector<double> sorted;         // measures of a row
    GrowingArray<std::uint32_t> words;  // rows, as in WallRows
    std::uint64_t walls = 0;            // in those rows
    std::uint64_t target = 0;           // walls before them in rows_
  };
  /// Takes the row that is not finished out of rows_.
  void reopen(std::uint32_t rank);
  void share_out(std::span<const std::uint32_t> pair_seed);
  void fill(Part& part, std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);
  /// Sorts the open row and sums what is with the same neighbour.
  void close_row(Part& part, std::uint32_t rank);
  void append_parts();

  int threads_;
  WallRows rows_;
  std::uint32_t next_ = 0;  // the first rank without a row yet
  std::vector<Part> parts_;
  std::uint32_t open_rank_ = 0;  // the rank that goes on from the last chunk, with its row so far
  std::vector<std::int32_t> open_neighbor_;
  std::vector<double> open_measure_;
};

/// The second half of WallCollector::finish. `rows` are used up.
Adjacency match_walls(WallRows rows, const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                      double negligible, int threads);

}  // namespace powercell
