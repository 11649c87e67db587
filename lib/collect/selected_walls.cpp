#include "lib/collect/selected_walls.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "kernels/layout.h"

namespace powercell {

void SelectedWalls::add(std::span<const std::uint32_t> pair_row, std::span<const std::uint32_t> pair_seed,
                        const PieceSet& pieces) {
  for (std::size_t k = 0; k < pair_row.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    const PieceBatch& batch = pieces.batches[pieces.batch[k]];
    const std::uint32_t row = pieces.row[k];
    for (std::uint32_t f = 0; f < batch.faces(row); ++f) {
      const std::int32_t border = batch.borders(row)[f];
      if (border < 0) continue;
      const auto neighbor = static_cast<std::uint32_t>(border);
      walls_.push_back({pair_row[k], seeds_.input[neighbor],
                        placement_ ? placement_->shift_of_wall(pair_seed[k], neighbor) : Shift{},
                        batch.walls(row)[f]});
    }
  }
}

Adjacency SelectedWalls::finish(std::span<const std::uint32_t> place, const std::vector<SeedStatus>& status,
                                double unit) {
  std::erase_if(walls_, [&](const Wall& wall) { return status[place[wall.row]] != SeedStatus::ok; });
  const auto key = [&](const Wall& wall) { return std::tuple(place[wall.row], wall.neighbor, wall.shift); };
  // Stable, so that the sums below are in the order of the pairs.
  std::stable_sort(walls_.begin(), walls_.end(),
                   [&](const Wall& a, const Wall& b) { return key(a) < key(b); });
  Adjacency out;
  out.offset.assign(status.size() + 1, 0);
  for (std::size_t k = 0; k < walls_.size();) {
    const Wall& wall = walls_[k];
    double measure = 0;
    for (; k < walls_.size() && key(walls_[k]) == key(wall); ++k) measure += walls_[k].measure;
    if (measure == 0) continue;
    ++out.offset[place[wall.row] + std::size_t{1}];
    out.neighbor.push_back(wall.neighbor);
    out.wall.push_back(measure * unit);
    if (placement_) out.shift.push_back(wall.shift);
  }
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  return out;
}

}  // namespace powercell
