/// \file
/// Collects the walls of the cells of some seeds, as seen from these cells. Internal.
#pragma once

#include <cstdint>
#include <powercell/results.hpp>
#include <span>
#include <vector>

#include "lib/clip/pieces.hpp"
#include "lib/periodic/images.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

class SelectedWalls {
 public:
  /// Keeps the references. \param placement  of a periodic domain, else null
  SelectedWalls(const SeedSet& seeds, const Placement* placement) : seeds_(seeds), placement_(placement) {}

  /// Adds the pieces of a chunk. \param pair_row  the row of each pair in the selection
  void add(std::span<const std::uint32_t> pair_row, std::span<const std::uint32_t> pair_seed,
           const PieceSet& pieces);

  /// The rows in the order of the selection, walls times `unit`. To be called once.
  /// \param place   of each row in the selection
  /// \param status  by place: walls of cells that are not ok are left out
  Adjacency finish(std::span<const std::uint32_t> place, const std::vector<SeedStatus>& status, double unit);

 private:
  struct Wall {
    std::uint32_t row, neighbor;  // the neighbour by input index
    Shift shift;
    double measure;
  };
  const SeedSet& seeds_;
  const Placement* placement_;
  std::vector<Wall> walls_;
};

}  // namespace powercell
