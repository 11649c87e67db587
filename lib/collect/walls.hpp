/// \file
/// Gathers the walls of clipped pieces into the symmetric adjacency.
#pragma once

#include <cstdint>
#include <cstring>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/base/memory.hpp"
#include "lib/clip/pieces.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The walls of one cell; memory owned elsewhere. Their number comes first and measures stand behind the
/// neighbours, so that a row is one piece of memory.
struct WallRow {
  static constexpr std::uint32_t lanes = 8;  ///< there is room for whole vectors of so many neighbours
  std::uint32_t* words;

  static constexpr std::size_t words_before_measures(std::size_t walls) {
    return 2 + (walls + lanes - 1) / lanes * lanes;
  }
  static constexpr std::size_t words_for(std::size_t walls) {
    return words_before_measures(walls) + 2 * walls;
  }
  std::size_t count() const { return words[0]; }
  /// Ranks, none twice, those below the row's own first.
  std::uint32_t* neighbors() const { return words + 1; }
  double* measures() const { return reinterpret_cast<double*>(words + words_before_measures(count())); }
};

/// What each cell says of its walls, by rank. Rows stay where the thread that made them put them.
class WallRows {
 public:
  using Memory = std::vector<GrowingArray<std::uint32_t>>;
  /// \param memory  of earlier ones
  WallRows(std::size_t ranks, std::size_t parts, Memory memory);
  Memory release() && { return std::move(memory_); }
  WallRow row(std::uint32_t rank) {
    return {memory_[place_[rank].part].data() + static_cast<std::size_t>(place_[rank].word)};
  }
  void prefetch_place(std::uint32_t rank) const { prefetch(&place_[rank]); }
  /// A row of `count` walls, not filled in, in the part of one thread. It replaces an earlier one of this
  /// rank.
  WallRow add(std::size_t part, std::uint32_t rank, std::size_t count);

 private:
  struct Place {
    std::uint64_t part : 16, word : 48;
  };
  std::vector<Place> place_;  // at first all at a row without walls
  Memory memory_;
};

/// Sorts `count` keys below 2^31 ascending into `sorted_key`, and the values with them; equal keys keep their
/// order. Returns whether there are equal keys. Input and output must not overlap.
bool sort_row(const std::uint32_t* key, const double* value, std::size_t count, std::uint32_t* sorted_key,
              double* sorted_value);

class WallCollector {
 public:
  WallCollector(std::size_t ranks, int threads, WallRows::Memory memory = {});

  /// Adds the pieces of a chunk; ranks ascend over the chunks, and one rank may go on in the next chunk.
  void add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);

  /// The adjacency in input order between seeds whose status is ok, walls times `unit`. The two sides of
  /// a wall are averaged. A wall that only one side has is rounding if it is below `negligible` of the
  /// largest wall of its cell, and left out; above, it is kept and shows in Adjacency::asymmetry.
  Adjacency finish(const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                   double negligible);

  /// Its memory, for the next one. Nothing may be asked of this one any more.
  WallRows::Memory release() && { return std::move(rows_).release(); }

 private:
  /// The walls of several pieces, in the order of the pairs.
  struct OpenRow {
    std::vector<std::uint32_t> neighbor;
    std::vector<double> measure;
    std::size_t size = 0;  // the vectors may be longer
    void add(const std::int32_t* border, const double* wall, std::size_t count);
  };
  /// The share of one thread: the pairs [begin, end) of the chunk, with all of each of their ranks.
  struct Part {
    std::size_t begin = 0, end = 0;
    OpenRow open;
    std::vector<std::uint32_t> neighbor;  // of a row, sorted
    std::vector<double> measure;
  };
  /// The walls of a rank so far, for it may go on in this chunk.
  void reopen(std::uint32_t rank);
  void divide(std::span<const std::uint32_t> pair_seed);
  void fill(std::size_t part, std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);
  /// The row of a rank with one piece, in which each neighbour is once.
  void add_row(std::size_t part, std::uint32_t rank, const PieceBatch& batch, std::size_t row);
  /// Sums what is with the same neighbour in the open row.
  void close_row(std::size_t part, std::uint32_t rank);

  WallRows rows_;
  int threads_;
  std::vector<Part> parts_;
  std::uint32_t open_rank_;  // the rank that goes on from the last chunk, with its row so far
  std::vector<std::int32_t> open_neighbor_;
  std::vector<double> open_measure_;
};

/// The second half of WallCollector::finish. `rows` are used up.
Adjacency match_walls(WallRows& rows, const SeedSet& seeds, const std::vector<SeedStatus>& status,
                      double unit, double negligible, int threads);

}  // namespace powercell
