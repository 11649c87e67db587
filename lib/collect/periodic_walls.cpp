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

constexpr std::size_t shared_cells = 4096;  // with fewer ranks, threads cost more than they save

Shift opposite(const Shift& shift) {
  return {-shift[0], -shift[1], -shift[2]};
}

}  // namespace

PeriodicWalls::PeriodicWalls(const Placement& placement, int threads)
    : placement_(placement), threads_(threads), first_(placement.images.own), count_(placement.images.own) {}

template <class Body>
void PeriodicWalls::for_ranks(const Body& body) const {
  const std::size_t count = placement_.images.own;
  parallel_for(threads_for(count, threads_, shared_cells), count, [&](std::size_t begin, std::size_t end) {
    body(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
  });
}

/// Copies the walls of a cell to their places; sums those of an image that repeats.
void PeriodicWalls::fill_row(std::uint32_t rank, const PieceBatch& batch, std::uint32_t row) {
  const std::int32_t* const border = batch.borders(row);
  const double* const measure = batch.walls(row);
  std::uint32_t* const neighbor = neighbors_.data() + first_[rank];
  double* const wall = measures_.data() + first_[rank];
  std::uint32_t count = 0;
  for (std::uint32_t f = 0; f < batch.faces(row); ++f) {
    if (border[f] < 0) continue;
    const auto other = static_cast<std::uint32_t>(border[f]);
    std::uint32_t at =
        batch.repeats ? static_cast<std::uint32_t>(std::find(neighbor, neighbor + count, other) - neighbor)
                      : count;
    if (at < count) {
      wall[at] += measure[f];
      continue;
    }
    neighbor[count] = other;
    wall[count++] = measure[f];
  }
  count_[rank] = count;
}

void PeriodicWalls::add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  const auto has_walls = [&](std::size_t k) {
    return pieces.status[k] == PIECE_DONE || pieces.status[k] == PIECE_FLAT;
  };
  std::uint64_t end = neighbors_.size();
  for (std::size_t k = 0; k < pair_seed.size(); ++k) {
    first_[pair_seed[k]] = end;
    count_[pair_seed[k]] = 0;
    if (has_walls(k)) end += pieces.batches[pieces.batch[k]].faces(pieces.row[k]);
  }
  neighbors_.resize(end, 4);  // of some chunks
  measures_.resize(end, 4);
  parallel_for(threads_for(pair_seed.size(), threads_, shared_cells), pair_seed.size(),
               [&](std::size_t begin, std::size_t stop) {
                 for (std::size_t k = begin; k < stop; ++k)
                   if (has_walls(k)) fill_row(pair_seed[k], pieces.batches[pieces.batch[k]], pieces.row[k]);
               });
}

/// The wall of the neighbour with this cell in the opposite image, or the end of its row.
std::uint64_t PeriodicWalls::other_side(std::uint32_t rank, std::uint64_t wall) const {
  const Images& images = placement_.images;
  const std::uint32_t other = neighbors_.data()[wall], j = images.seed_of(other);
  std::uint64_t at = begin_of(j);
  const std::uint64_t end = end_of(j);
  if (other < images.own) {
    while (at < end && neighbors_.data()[at] != rank) ++at;
    return at;
  }
  const std::int32_t back = -images.code[other - images.own];
  const auto is_back = [&](std::uint32_t image) {
    return image >= images.own && images.rank[image - images.own] == rank &&
           images.code[image - images.own] == back;
  };
  while (at < end && !is_back(neighbors_.data()[at])) ++at;
  return at;
}

/// Replaces both sides of walls by their means, as the cell that comes first. Walls with seeds without cells
/// become 0.
PeriodicWalls::Difference PeriodicWalls::match(std::uint32_t rank) {
  const Images& images = placement_.images;
  Difference worst;
  for (std::uint64_t wall = begin_of(rank); wall < end_of(rank); ++wall) {
    const std::uint32_t j = images.seed_of(neighbors_.data()[wall]);
    if (!ok_[rank] || !ok_[j]) {
      measures_.data()[wall] = 0;
      continue;
    }
    if (j < rank || (j == rank && images.code[neighbors_.data()[wall] - images.own] > 0)) continue;
    const std::uint64_t other = other_side(rank, wall);
    if (other == end_of(j)) continue;
    const double difference = std::fabs(measures_.data()[wall] - measures_.data()[other]);
    if (difference > worst.value) worst = {difference, rank, j};
    measures_.data()[wall] = measures_.data()[other] =
        -((measures_.data()[wall] + measures_.data()[other]) / 2);
  }
  return worst;
}

std::vector<PeriodicWalls::Missing> PeriodicWalls::settle_one_sided(double negligible, Difference& worst) {
  const Images& images = placement_.images;
  const auto largest = [&](std::uint32_t rank) {
    double most = 0;
    for (std::uint64_t wall = begin_of(rank); wall < end_of(rank); ++wall)
      most = std::max(most, std::fabs(measures_.data()[wall]));
    return most;
  };
  std::vector<Missing> missing;
  std::mutex mutex;
  const auto settle_row = [&](std::uint32_t rank) {
    for (std::uint64_t wall = begin_of(rank); wall < end_of(rank); ++wall) {
      const double measure = measures_.data()[wall];
      if (std::signbit(measure) || measure == 0) continue;
      const std::uint32_t j = images.seed_of(neighbors_.data()[wall]);
      if (negligible > 0 && measure <= negligible * std::max(largest(rank), largest(j))) {
        measures_.data()[wall] = 0;
        continue;
      }
      const std::lock_guard lock(mutex);
      if (measure > worst.value || (measure == worst.value && rank < worst.from)) worst = {measure, rank, j};
      missing.push_back({j,
                         {images.seeds.input[rank],
                          opposite(placement_.shift_of_wall(rank, neighbors_.data()[wall])), measure}});
    }
  };
  const auto settle_rows = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t rank = begin; rank < end; ++rank) settle_row(rank);
  };
  if (negligible > 0)
    settle_rows(0, images.own);  // reads rows of others
  else
    for_ranks(settle_rows);
  std::stable_sort(missing.begin(), missing.end(), [](const Missing& a, const Missing& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.entry < b.entry;
  });
  return missing;
}

std::uint64_t PeriodicWalls::kept_walls(std::uint32_t rank) const {
  std::uint64_t kept = 0;
  for (std::uint64_t wall = begin_of(rank); wall < end_of(rank); ++wall) kept += measures_.data()[wall] != 0;
  return kept;
}

/// Whether some wall of a row may have a shift.
bool PeriodicWalls::has_shifts(std::uint32_t rank) const {
  const Images& images = placement_.images;
  if (is_moved_[rank]) return true;
  for (std::uint64_t wall = begin_of(rank); wall < end_of(rank); ++wall)
    if (neighbors_.data()[wall] >= images.own || is_moved_[neighbors_.data()[wall]]) return true;
  return false;
}

void PeriodicWalls::write_row(std::uint32_t rank, std::span<const Missing> missing, double unit,
                              Adjacency& out) const {
  const Images& images = placement_.images;
  const std::uint64_t begin = begin_of(rank), count = count_[rank];
  const std::uint64_t to = out.offset[images.seeds.input[rank]];
  if (count == 0 && missing.empty()) return;
  if (missing.empty() && kept_walls(rank) == count && !has_shifts(rank)) {
    thread_local std::vector<std::uint32_t> neighbor;
    thread_local std::vector<double> wall;
    neighbor.resize(count);
    wall.resize(count);
    for (std::uint64_t k = 0; k < count; ++k) {
      neighbor[k] = images.seeds.input[neighbors_.data()[begin + k]];
      wall[k] = std::fabs(measures_.data()[begin + k]) * unit;
    }
    sort_row(neighbor.data(), wall.data(), count, &out.neighbor[to], &out.wall[to]);
    return;
  }
  std::vector<Entry> row;
  for (std::uint64_t wall = begin; wall < begin + count; ++wall)
    if (measures_.data()[wall] != 0)
      row.push_back({images.seeds.input[neighbors_.data()[wall]],
                     placement_.shift_of_wall(rank, neighbors_.data()[wall]),
                     std::fabs(measures_.data()[wall]) * unit});
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
  ok_.resize(images.own);
  is_moved_.resize(images.own);
  for_ranks([&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t rank = begin; rank < end; ++rank) {
      is_moved_[rank] = !placement_.is_inside(rank);
      ok_[rank] = status[images.seeds.input[rank]] == SeedStatus::ok;
    }
  });
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
  for_ranks([&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t rank = begin; rank < end; ++rank)
      out.offset[std::size_t{images.seeds.input[rank]} + 1] = kept_walls(rank) + missing_of(rank).size();
  });
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
