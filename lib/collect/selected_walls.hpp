/// \file
/// Collects the walls of the cells of some seeds in a periodic domain, as seen from these cells.
#pragma once

#include <array>
#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/cell/pieces.hpp"
#include "lib/periodic/images.hpp"

namespace powercell {

class SelectedWalls {
 public:
  /// Keeps the references.
  /// \param rows  selected
  SelectedWalls(const Placement& placement, std::size_t rows, int threads)
      : placement_(placement), threads_(threads), row_(rows) {
    walls_.reserve(rows * usual_walls[placement.images.seeds.dimension == 2 ? 0 : 1]);
  }

  /// Adds the pieces of a chunk. Rows ascend over all chunks.
  /// \param pair_row  of each pair
  void add(std::span<const std::uint32_t> pair_row, std::span<const std::uint32_t> pair_seed,
           const PieceSet& pieces);

  /// Removes the walls of a row, so that others can be added.
  void discard(std::uint32_t row) { row_[row] = {}; }

  /// The rows in the order of the selection, walls times `unit`. To be called once.
  /// \param place   of each row in the selection
  /// \param status  by place: walls of cells that are not ok are left out
  Adjacency finish(std::span<const std::uint32_t> place, const std::vector<SeedStatus>& status, double unit);

 private:
  /// A few more than cells have on average, so that memory is taken once.
  static constexpr std::array<std::size_t, 2> usual_walls{7, 18};

  struct Wall {
    std::uint32_t neighbor;  // by input index
    Shift shift;
    double measure;
    bool is_with(const Wall& other) const { return neighbor == other.neighbor && shift == other.shift; }
    bool operator<(const Wall& other) const {
      return neighbor != other.neighbor ? neighbor < other.neighbor : shift < other.shift;
    }
  };
  /// The walls [first, first + count).
  struct Row {
    std::size_t first = 0, count = 0;
  };
  /// Sorts the walls of a row, sums those with the same image of a seed, and drops those of measure 0.
  void settle(Row& row);

  const Placement& placement_;
  int threads_;
  std::vector<Row> row_;
  std::vector<Wall> walls_;
};

}  // namespace powercell
