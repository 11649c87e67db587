#include "lib/collect/periodic_walls.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "kernels/layout.h"
#include "lib/base/memory.hpp"
#include "lib/base/threads.hpp"
#include "lib/collect/walls.hpp"

namespace powercell {
namespace {

constexpr std::size_t share_count = 4096;  // with fewer ranks, threads cost more than they save

Shift opposite(const Shift& shift) {
  return {-shift[0], -shift[1], -shift[2]};
}

}  // namespace

PeriodicWalls::PeriodicWalls(const Placement& placement, int threads)
    : placement_(placement), threads_(threads), first_{0} {
  first_.reserve(std::size_t{placement.images.own} + 1);
}

template <class Body>
void PeriodicWalls::for_ranks(const Body& body) const {
  const std::size_t count = placement_.images.own;
  parallel_for(threads_for(count, threads_, share_count), count, [&](std::size_t begin, std::size_t end) {
    body(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
  });
}

/// Appends a row in which an image may repeat.
void PeriodicWalls::append_merged(const std::int32_t* border, const double* measure, std::uint32_t count) {
  const auto begin = static_cast<std::ptrdiff_t>(first_.back());
  for (std::uint32_t f = 0; f < count; ++f) {
    if (border[f] < 0) continue;
    const auto other = static_cast<std::uint32_t>(border[f]);
    const auto found = std::find(neighbor_.begin() + begin, neighbor_.end(), other);
    if (found != neighbor_.end()) {
      measure_[static_cast<std::size_t>(found - neighbor_.begin())] += measure[f];
      continue;
    }
    neighbor_.push_back(other);
    measure_.push_back(measure[f]);
  }
}

void PeriodicWalls::add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  for (std::size_t k = 0; k < pair_seed.size(); ++k) {
    first_.resize(pair_seed[k] + std::size_t{1}, neighbor_.size());  // ranks without cells
    if (pieces.status[k] == PIECE_DONE || pieces.status[k] == PIECE_FLAT) {
      const PieceBatch& batch = pieces.batches[pieces.batch[k]];
      const std::uint32_t row = pieces.row[k], count = batch.faces(row);
      const std::int32_t* const border = batch.borders(row);
      const double* const measure = batch.walls(row);
      if (batch.repeats) {
        append_merged(border, measure, count);
      } else {
        for (std::uint32_t f = 0; f < count; ++f) {
          if (border[f] < 0) continue;
          neighbor_.push_back(static_cast<std::uint32_t>(border[f]));
          measure_.push_back(measure[f]);
        }
      }
    }
    first_.push_back(neighbor_.size());
  }
}

/// The wall of the neighbour with this cell in the opposite image, or the end of its row.
std::uint64_t PeriodicWalls::other_side(std::uint32_t rank, std::uint64_t wall) const {
  const Images& images = placement_.images;
  const std::uint32_t other = neighbor_[wall], j = images.seed_of(other);
  std::uint64_t at = first_[j];
  const std::uint64_t end = first_[j + std::size_t{1}];
  if (other < images.own) {
    while (at < end && neighbor_[at] != rank) ++at;
    return at;
  }
  const Shift back = opposite(images.shift_of(other));
  while (at < end && (neighbor_[at] < images.own || images.seed_of(neighbor_[at]) != rank ||
                      images.shift_of(neighbor_[at]) != back))
    ++at;
  return at;
}

/// Replaces both sides of walls by their means, as the cell that comes first. Walls with seeds without cells
/// become 0.
PeriodicWalls::Difference PeriodicWalls::match(std::uint32_t rank) {
  const Images& images = placement_.images;
  Difference worst;
  for (std::uint64_t wall = first_[rank]; wall < first_[rank + std::size_t{1}]; ++wall) {
    const std::uint32_t j = images.seed_of(neighbor_[wall]);
    if (!ok_[rank] || !ok_[j]) {
      measure_[wall] = 0;
      continue;
    }
    if (j < rank || (j == rank && Shift{} < images.shift_of(neighbor_[wall]))) continue;
    const std::uint64_t other = other_side(rank, wall);
    if (other == first_[j + std::size_t{1}]) continue;
    const double difference = std::fabs(measure_[wall] - measure_[other]);
    if (difference > worst.value) worst = {difference, rank, j};
    measure_[wall] = measure_[other] = -((measure_[wall] + measure_[other]) / 2);
  }
  return worst;
}

std::vector<PeriodicWalls::Missing> PeriodicWalls::settle_one_sided(double negligible, Difference& worst) {
  const Images& images = placement_.images;
  const auto largest = [&](std::uint32_t rank) {
    double most = 0;
    for (std::uint64_t wall = first_[rank]; wall < first_[rank + std::size_t{1}]; ++wall)
      most = std::max(most, std::fabs(measure_[wall]));
    return most;
  };
  std::vector<Missing> missing;
  for (std::uint32_t rank = 0; rank < images.own; ++rank)
    for (std::uint64_t wall = first_[rank]; wall < first_[rank + std::size_t{1}]; ++wall) {
      const double measure = measure_[wall];
      if (std::signbit(measure) || measure == 0) continue;
      const std::uint32_t j = images.seed_of(neighbor_[wall]);
      if (measure <= negligible * std::max(largest(rank), largest(j))) {
        measure_[wall] = 0;
        continue;
      }
      if (measure > worst.value) worst = {measure, rank, j};
      missing.push_back(
          {j,
           {images.seeds.input[rank], opposite(placement_.shift_of_wall(rank, neighbor_[wall])), measure}});
    }
  std::stable_sort(missing.begin(), missing.end(),
                   [](const Missing& a, const Missing& b) { return a.rank < b.rank; });
  return missing;
}

std::uint64_t PeriodicWalls::kept_walls(std::uint32_t rank) const {
  std::uint64_t kept = 0;
  for (std::uint64_t wall = first_[rank]; wall < first_[rank + std::size_t{1}]; ++wall)
    kept += measure_[wall] != 0;
  return kept;
}

/// Whether some wall of a row may have a shift.
bool PeriodicWalls::has_shifts(std::uint32_t rank) const {
  const Images& images = placement_.images;
  const auto wrapped = [&](std::uint32_t r) { return placement_.wrapped[images.seeds.input[r]] != Shift{}; };
  if (wrapped(rank)) return true;
  for (std::uint64_t wall = first_[rank]; wall < first_[rank + std::size_t{1}]; ++wall)
    if (neighbor_[wall] >= images.own || wrapped(neighbor_[wall])) return true;
  return false;
}

void PeriodicWalls::write_row(std::uint32_t rank, std::span<const Missing> missing, double unit,
                              Adjacency& out) const {
  const Images& images = placement_.images;
  const std::uint64_t begin = first_[rank], count = first_[rank + std::size_t{1}] - begin;
  const std::uint64_t to = out.offset[images.seeds.input[rank]];
  if (missing.empty() && kept_walls(rank) == count && !has_shifts(rank)) {
    std::vector<std::uint32_t> neighbor(count);
    std::vector<double> wall(count);
    for (std::uint64_t k = 0; k < count; ++k) {
      neighbor[k] = images.seeds.input[neighbor_[begin + k]];
      wall[k] = std::fabs(measure_[begin + k]) * unit;
    }
    sort_row(neighbor.data(), wall.data(), count, &out.neighbor[to], &out.wall[to]);
    return;
  }
  std::vector<Entry> row;
  for (std::uint64_t wall = begin; wall < begin + count; ++wall)
    if (measure_[wall] != 0)
      row.push_back({images.seeds.input[neighbor_[wall]], placement_.shift_of_wall(rank, neighbor_[wall]),
                     std::fabs(measure_[wall]) * unit});
  for (const Missing& other : missing)
    row.push_back({other.entry.neighbor, other.entry.shift, other.entry.wall * unit});
  std::sort(row.begin(), row.end());
  for (std::size_t k = 0; k < row.size(); ++k) {
    out.neighbor[to + k] = row[k].neighbor;
    out.wall[to + k] = row[k].wall;
    out.shift[to + k] = row[k].shift;
  }
}

Adjacency PeriodicWalls::finish(const std::vector<SeedStatus>& status, double unit, double negligible) {
  const Images& images = placement_.images;
  first_.resize(std::size_t{images.own} + 1, neighbor_.size());
  ok_.resize(images.own);
  for (std::uint32_t rank = 0; rank < images.own; ++rank)
    ok_[rank] = status[images.seeds.input[rank]] == SeedStatus::ok;
  Difference worst;
  std::mutex mutex;
  for_ranks([&](std::uint32_t begin, std::uint32_t end) {
    Difference here;
    for (std::uint32_t rank = begin; rank < end; ++rank) {
      const Difference of_row = match(rank);
      if (of_row.value > here.value) here = of_row;
    }
    const std::lock_guard lock(mutex);
    if (here.value > worst.value || (here.value == worst.value && here.from < worst.from)) worst = here;
  });
  const std::vector<Missing> missing = settle_one_sided(negligible, worst);
  const auto missing_of = [&](std::uint32_t rank) {
    const auto [from, end] =
        std::equal_range(missing.begin(), missing.end(), Missing{rank, {}},
                         [](const Missing& a, const Missing& b) { return a.rank < b.rank; });
    return std::span(missing).subspan(static_cast<std::size_t>(from - missing.begin()),
                                      static_cast<std::size_t>(end - from));
  };
  Adjacency out;
  out.offset.assign(images.seeds.input_count + 1, 0);
  for (std::uint32_t rank = 0; rank < images.own; ++rank)
    out.offset[std::size_t{images.seeds.input[rank]} + 1] = kept_walls(rank) + missing_of(rank).size();
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  resize_populated(out.neighbor, out.offset.back(), threads_);
  resize_populated(out.wall, out.offset.back(), threads_);
  resize_populated(out.shift, out.offset.back(), threads_);
  for_ranks([&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t rank = begin; rank < end; ++rank) write_row(rank, missing_of(rank), unit, out);
  });
  out.asymmetry = worst.value * unit;
  if (worst.value > 0) out.asymmetric = {images.seeds.input[worst.from], images.seeds.input[worst.to]};
  return out;
}

}  // namespace powercell
