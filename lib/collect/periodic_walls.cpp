#include "lib/collect/periodic_walls.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"

namespace powercell {

PeriodicWalls::PeriodicWalls(const Placement& placement)
    : placement_(placement),
      first_(placement.images.seeds.input_count),
      count_(placement.images.seeds.input_count) {}

void PeriodicWalls::add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  for (std::size_t k = 0; k < pair_seed.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    const std::uint32_t rank = pair_seed[k], i = placement_.images.seeds.input[rank];
    const PieceBatch& batch = pieces.batches[pieces.batch[k]];
    const std::int32_t* const border = batch.borders(pieces.row[k]);
    const double* const measure = batch.walls(pieces.row[k]);
    first_[i] = wall_.size();
    for (std::uint32_t f = 0; f < batch.faces(pieces.row[k]); ++f) {
      if (border[f] < 0 || !(measure[f] > 0)) continue;
      const auto other = static_cast<std::uint32_t>(border[f]);
      wall_.push_back(
          {placement_.images.seeds.input[other], placement_.shift_of_wall(rank, other), measure[f], false});
    }
    count_[i] = static_cast<std::uint32_t>(wall_.size() - first_[i]);
  }
}

/// Sorts each row and sums the walls of one image.
void PeriodicWalls::sort_rows(int threads) {
  parallel_for(threads_for(count_.size(), threads, 4096), count_.size(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   const std::span<Wall> walls = row(static_cast<std::uint32_t>(i));
                   std::stable_sort(walls.begin(), walls.end());
                   std::uint32_t kept = 0;
                   for (const Wall& wall : walls) {
                     if (kept > 0 && walls[kept - 1].matches(wall))
                       walls[kept - 1].measure += wall.measure;
                     else
                       walls[kept++] = wall;
                   }
                   count_[i] = kept;
                 }
               });
}

PeriodicWalls::Wall* PeriodicWalls::other_side(std::uint32_t i, const Wall& wall) {
  const std::span<Wall> walls = row(wall.neighbor);
  const Wall back{i, {-wall.shift[0], -wall.shift[1], -wall.shift[2]}, 0, false};
  const auto found = std::lower_bound(walls.begin(), walls.end(), back);
  return found != walls.end() && found->matches(back) ? &*found : nullptr;
}

/// Replaces both sides of the walls of cell i by their means, as the cell that comes first.
PeriodicWalls::Difference PeriodicWalls::match(std::uint32_t i) {
  Difference worst;
  for (Wall& wall : row(i)) {
    const bool first = wall.neighbor != i ? i < wall.neighbor : wall.shift < Shift{};
    if (!first) continue;
    Wall* const other = other_side(i, wall);
    if (other == nullptr) continue;
    const double difference = std::fabs(wall.measure - other->measure);
    if (difference > worst.value) worst = {difference, i, wall.neighbor};
    wall.measure = other->measure = (wall.measure + other->measure) / 2;
    wall.two_sided = other->two_sided = true;
  }
  return worst;
}

void PeriodicWalls::settle_one_sided(const std::vector<SeedStatus>& status, double negligible,
                                     Difference& worst) {
  std::vector<double> largest(count_.size());
  std::vector<std::pair<std::uint32_t, Wall>> missing;
  for (std::uint32_t i = 0; i < count_.size(); ++i)
    for (const Wall& wall : row(i)) largest[i] = std::max(largest[i], wall.measure);
  for (std::uint32_t i = 0; i < count_.size(); ++i)
    for (Wall& wall : row(i)) {
      if (wall.two_sided) continue;
      const bool ok = status[i] == SeedStatus::ok && status[wall.neighbor] == SeedStatus::ok;
      if (!ok || wall.measure <= negligible * std::max(largest[i], largest[wall.neighbor])) {
        wall.measure = 0;
        continue;
      }
      if (wall.measure > worst.value) worst = {wall.measure, i, wall.neighbor};
      missing.push_back(
          {wall.neighbor, {i, {-wall.shift[0], -wall.shift[1], -wall.shift[2]}, wall.measure, true}});
    }
  for (const auto& [i, wall] : missing) {
    const std::span<Wall> walls = row(i);
    std::vector<Wall> longer(walls.begin(), walls.end());
    longer.insert(std::upper_bound(longer.begin(), longer.end(), wall), wall);
    first_[i] = wall_.size();
    count_[i] = static_cast<std::uint32_t>(longer.size());
    wall_.insert(wall_.end(), longer.begin(), longer.end());
  }
}

Adjacency PeriodicWalls::finish(const std::vector<SeedStatus>& status, double unit, double negligible,
                                int threads) {
  const auto n = static_cast<std::uint32_t>(count_.size());
  for (std::uint32_t i = 0; i < n; ++i)
    if (status[i] != SeedStatus::ok) count_[i] = 0;
  sort_rows(threads);
  Difference worst;
  std::mutex mutex;
  parallel_for(threads_for(n, threads, 4096), n, [&](std::size_t begin, std::size_t end) {
    Difference here;
    for (std::size_t i = begin; i < end; ++i) {
      const Difference of_row = match(static_cast<std::uint32_t>(i));
      if (of_row.value > here.value) here = of_row;
    }
    const std::lock_guard lock(mutex);
    if (here.value > worst.value || (here.value == worst.value && here.from < worst.from)) worst = here;
  });
  settle_one_sided(status, negligible, worst);
  Adjacency out;
  out.offset.assign(std::size_t{n} + 1, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const Wall& wall : row(i)) {
      if (!(wall.measure > 0)) continue;
      out.neighbor.push_back(wall.neighbor);
      out.wall.push_back(wall.measure * unit);
      out.shift.push_back(wall.shift);
    }
    out.offset[std::size_t{i} + 1] = out.neighbor.size();
  }
  out.asymmetry = worst.value * unit;
  if (worst.value > 0) out.asymmetric = {worst.from, worst.to};
  return out;
}

}  // namespace powercell
