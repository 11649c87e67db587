/// \file
/// Collects the walls of clipped pieces into the symmetric adjacency.
#pragma once

#include <cstdint>
#include <cstring>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/base/memory.hpp"
#include "lib/cell/pieces.hpp"
#include "lib/periodic/images.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// A view of the walls of one cell: their number, the neighbours and the measures in one block of memory.
struct WallRow {
  static constexpr std::uint32_t lanes = 8;  ///< neighbours are padded to whole vectors of so many
  std::uint32_t* words;

  static constexpr std::size_t words_before_measures(std::size_t walls) {
    return 2 + (walls + lanes - 1) / lanes * lanes;
  }
  static constexpr std::size_t words_for(std::size_t walls) {
    return words_before_measures(walls) + 2 * walls;
  }
  std::size_t count() const { return words[0]; }
  /// Distinct ranks, those below the row's own rank first.
  std::uint32_t* neighbors() const { return words + 1; }
  double* measures() const { return reinterpret_cast<double*>(words + words_before_measures(count())); }
};

/// The walls of each cell as seen from that cell, by rank. Each thread appends rows to memory of its own.
class WallRows {
 public:
  using Memory = std::vector<GrowingArray<std::uint32_t>>;
  /// \param memory  released by earlier rows
  WallRows(std::size_t ranks, std::size_t parts, Memory memory);
  Memory release() && { return std::move(memory_); }
  WallRow row(std::uint32_t rank) {
    return {memory_[place_[rank].part].data() + static_cast<std::size_t>(place_[rank].word)};
  }
  static constexpr std::uint32_t no_rank = ~std::uint32_t{0};
  /// Brings rows into the cache that will soon be read: results are written entry after entry, and the rows
  /// of entries are scattered in memory.
  /// \param rank    of each entry, or no_rank
  /// \param offset  of the walls of each entry among those of all, as in Adjacency, or nearly
  /// \param i  the entry at work
  /// \param last  the end of the entries
  void fetch_ahead(std::span<const std::uint32_t> rank, std::span<const std::uint64_t> offset, std::size_t i,
                   std::size_t last);
  /// Adds an uninitialised row of `count` walls to the memory of one thread. It replaces an earlier row of
  /// this rank.
  WallRow add(std::size_t part, std::uint32_t rank, std::size_t count);
  /// Leaves a rank without walls.
  void discard(std::uint32_t rank) { place_[rank] = {}; }

 private:
  struct Place {
    std::uint64_t part : 16, word : 48;
  };
  std::vector<Place> place_;  // initially of a row without walls
  Memory memory_;
};

/// Sorts `count` keys below 2^31 ascending into `sorted_key`, and the values with them; equal keys keep their
/// order. Returns whether there are equal keys. Input and output must not overlap.
bool sort_row(const std::uint32_t* key, const double* value, std::size_t count, std::uint32_t* sorted_key,
              double* sorted_value);

/// A wall in a periodic domain.
struct PlacedWall {
  std::uint32_t neighbor;  ///< by input index
  Shift shift;
  double measure;
  bool operator<(const PlacedWall& other) const {
    return neighbor != other.neighbor ? neighbor < other.neighbor : shift < other.shift;
  }
};
/// \param rank, neighbor  the latter of a seed or an image
PlacedWall placed(const Placement& placement, std::uint32_t rank, std::uint32_t neighbor, double measure);
/// Sorts the walls of a row, and writes them from an entry on, times `unit`.
void write_placed(std::vector<PlacedWall>& walls, double unit, std::uint64_t to, Adjacency& out);

/// The cells of a selection.
struct WallSelection {
  std::span<const std::uint32_t> rank;   ///< by row of the collector
  std::span<const std::uint32_t> place;  ///< the same in the order of the results
  const Placement* placement = nullptr;  ///< in a periodic domain
};

class WallCollector {
 public:
  WallCollector(std::size_t ranks, int threads, WallRows::Memory memory = {});

  /// Adds the pieces of a chunk. Ranks ascend over all chunks; a rank may continue in the next chunk.
  void add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);

  /// Removes the walls of a rank, so that others can be added in further chunks.
  void discard(std::uint32_t rank) { rows_.discard(rank); }
  /// Replaces the walls of a rank, after all chunks.
  /// \param neighbors  distinct
  /// \param thread  the number of the calling thread: several may set rows at a time
  void set_row(std::uint32_t rank, std::span<const std::uint32_t> neighbors, std::span<const double> measures,
               std::size_t thread = 0);
  /// Subtracts from the wall of a rank with a neighbour, if it has that wall. What is left within rounding
  /// counts as 0, so that there is no wall.
  void subtract(std::uint32_t rank, std::uint32_t neighbor, double measure);
  /// The neighbours of a rank as added.
  std::span<const std::uint32_t> neighbors(std::uint32_t rank) {
    const WallRow row = rows_.row(rank);
    return {row.neighbors(), row.count()};
  }

  /// The adjacency in input order between seeds whose status is ok, walls times `unit`. The two sides of a
  /// wall are averaged. A wall that only one side has is left out as rounding if it is at most `negligible`
  /// times the largest wall of either cell; otherwise it is kept and shows in Adjacency::asymmetry.
  Adjacency finish(const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                   double negligible);

  /// The same in a periodic domain, with shifts; ranks may be those of images.
  Adjacency finish(const Placement& placement, const std::vector<SeedStatus>& status, double unit,
                   double negligible);

  /// The walls of the cells of some seeds, as seen from these cells: rows of this collector are those of the
  /// selection, and their neighbours are ranks of `seeds`. Walls times `unit`.
  /// \param status  by place: walls of cells that are not ok are left out
  /// \param walls   otherwise there are neighbours only, in any order within a row; not in a periodic domain
  Adjacency finish_selected(const SeedSet& seeds, const WallSelection& selection,
                            const std::vector<SeedStatus>& status, double unit, bool walls);

  /// The memory, for another collector. This one must not be used any more.
  WallRows::Memory release() && { return std::move(rows_).release(); }

 private:
  /// The walls of the pieces of a rank, in the order of the pairs.
  struct OpenRow {
    std::vector<std::uint32_t> neighbor;
    std::vector<double> measure;
    std::size_t size = 0;  // the vectors may be longer
    void add(const std::int32_t* border, const double* wall, std::size_t count);
  };
  /// The share of one thread: the pairs [begin, end) of a chunk, which include all pairs of their ranks.
  struct Part {
    std::size_t begin = 0, end = 0;
    OpenRow open;
    std::vector<std::uint32_t> neighbor;  // of one row, sorted
    std::vector<double> measure;
  };
  /// Copies the walls of the last rank, which may continue in this chunk.
  void reopen(std::uint32_t rank);
  void divide(std::span<const std::uint32_t> pair_seed);
  void fill(std::size_t part, std::span<const std::uint32_t> pair_seed, const PieceSet& pieces);
  /// Adds the row of a rank with a single piece, in which no neighbour repeats.
  void add_row(std::size_t part, std::uint32_t rank, const PieceBatch& batch, std::size_t row);
  /// Adds the open row, with walls of the same neighbour summed.
  void close_row(std::size_t part, std::uint32_t rank);

  WallRows rows_;
  int threads_;
  std::vector<Part> parts_;
  std::uint32_t open_rank_;  // the rank that may continue from the last chunk, with its row so far
  std::vector<std::int32_t> open_neighbor_;
  std::vector<double> open_measure_;
};

/// The walls as each cell sees them, as WallCollector::finish_selected. Modifies `rows`.
Adjacency list_walls(WallRows& rows, const SeedSet& seeds, const WallSelection& selection,
                     const std::vector<SeedStatus>& status, double unit, bool walls, int threads);

/// Combines the two sides of each wall, as WallCollector::finish. Modifies `rows`.
Adjacency match_walls(WallRows& rows, const SeedSet& seeds, const std::vector<SeedStatus>& status,
                      double unit, double negligible, int threads);
Adjacency match_periodic_walls(WallRows& rows, const Placement& placement,
                               const std::vector<SeedStatus>& status, double unit, double negligible,
                               int threads);

}  // namespace powercell
