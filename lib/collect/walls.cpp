#include "lib/collect/walls.hpp"

#include <algorithm>

#include "kernels/layout.h"
#include "lib/collect/sort_row.hpp"
#include "lib/seeds/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t share_count = 2048;  // pairs; below, threads cost more than they save

/// With sums side by side, which one maximum after the other does not allow.
double largest_of(const double* values, std::size_t count) {
  double most[4] = {0, 0, 0, 0};
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4)
    for (std::size_t lane = 0; lane < 4; ++lane) most[lane] = std::max(most[lane], values[k + lane]);
  for (; k < count; ++k) most[0] = std::max(most[0], values[k]);
  return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
}

}  // namespace

WallCollector::WallCollector(std::size_t ranks, int threads) : threads_(threads) {
  rows_.end.resize(ranks);
  rows_.largest.resize(ranks);
}

void WallCollector::reopen(std::uint32_t rank) {
  open_rank_ = rank;
  open_neighbor_.clear();
  open_measure_.clear();
  if (rank + 1 != next_) return;  // begins in this chunk
  const WallRow row = rows_.row(rank);
  open_neighbor_.assign(row.neighbor, row.neighbor + row.count);
  for (std::size_t k = 0; k < row.count; ++k) open_measure_.push_back(row.measure(k));
  rows_.words.resize(rows_.begin(rank) * WallRows::words_per_wall);
}

void WallCollector::share_out(std::span<const std::uint32_t> pair_seed) {
  const std::size_t pairs = pair_seed.size();
  const std::size_t wanted = pairs < share_count ? 1 : static_cast<std::size_t>(std::max(threads_, 1));
  parts_.resize(wanted);
  std::size_t begin = 0;
  for (std::size_t p = 0; p < wanted; ++p) {
    Part& part = parts_[p];
    part.begin = begin;
    part.end = std::max(begin, pairs * (p + 1) / wanted);
    while (part.end > 0 && part.end < pairs && pair_seed[part.end] == pair_seed[part.end - 1]) ++part.end;
    part.first = begin < pairs ? pair_seed[begin] : pair_seed.back() + 1;
    part.last = part.end < pairs ? pair_seed[part.end] : pair_seed.back() + 1;
    begin = part.end;
  }
}

void WallCollector::OpenRow::add(const std::int32_t* border, const double* wall, std::size_t count) {
  if (size + count > neighbor.size()) {
    neighbor.resize(size + count);
    measure.resize(size + count);
  }
  for (std::size_t f = 0; f < count; ++f) {
    neighbor[size] = static_cast<std::uint32_t>(border[f]);  // the next overwrites what is no wall
    measure[size] = wall[f];
    size += border[f] >= 0 ? 1 : 0;
  }
}

void WallCollector::close_row(Part& part, std::uint32_t rank) {
  const std::size_t open = part.open.size, begin = part.walls * WallRows::words_per_wall;
  const std::size_t most = begin + open * WallRows::words_per_wall;
  if (most > part.words.size()) part.words.resize(most);
  if (part.sorted.size() < open) part.sorted.resize(open);
  std::uint32_t* const neighbor = part.words.data() + begin;
  std::vector<double>& measure = part.sorted;
  std::size_t count = open;
  if (sort_row(part.open.neighbor.data(), part.open.measure.data(), open, neighbor, measure.data())) {
    // Sums run in the order of the pairs, so chunks do not change a bit of them.
    count = 1;
    for (std::size_t k = 1; k < open; ++k) {
      if (neighbor[count - 1] == neighbor[k]) {
        measure[count - 1] += measure[k];
        continue;
      }
      neighbor[count] = neighbor[k];
      measure[count++] = measure[k];
    }
  }
  if (count > 0) std::memcpy(neighbor + count, measure.data(), count * sizeof(double));
  part.walls += count;
  rows_.largest[rank] = largest_of(measure.data(), count);
  rows_.end[rank] = part.walls;
}

void WallCollector::fill(Part& part, std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  part.walls = 0;
  std::size_t k = part.begin;
  for (std::uint32_t rank = part.first; rank < part.last; ++rank) {
    part.open.size = 0;
    if (rank == open_rank_) part.open.add(open_neighbor_.data(), open_measure_.data(), open_neighbor_.size());
    for (; k < part.end && pair_seed[k] == rank; ++k) {
      if (pieces.status[k] != PIECE_WHOLE && pieces.status[k] != PIECE_FLAT) continue;
      const PieceBatch& batch = pieces.batches[pieces.batch[k]];
      const std::size_t row = pieces.row[k], first = batch.face_offset[row];
      part.open.add(batch.border.data() + first, batch.wall.data() + first, batch.faces(row));
    }
    close_row(part, rank);
  }
}

void WallCollector::append_parts() {
  std::uint64_t total = rows_.walls();
  for (Part& part : parts_) {
    part.target = total;
    total += part.walls;
  }
  rows_.words.resize(total * WallRows::words_per_wall);
  parallel_for(static_cast<int>(parts_.size()), parts_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const Part& part = parts_[p];
      std::copy_n(part.words.data(), part.walls * WallRows::words_per_wall,
                  rows_.words.data() + part.target * WallRows::words_per_wall);
      for (std::uint32_t rank = part.first; rank < part.last; ++rank) rows_.end[rank] += part.target;
    }
  });
}

void WallCollector::add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  if (pair_seed.empty()) return;
  const std::uint32_t first = pair_seed.front();
  for (; next_ < first; ++next_) rows_.end[next_] = rows_.walls();  // ranks without a pair
  reopen(first);
  share_out(pair_seed);
  parallel_for(static_cast<int>(parts_.size()), parts_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) fill(parts_[p], pair_seed, pieces);
  });
  append_parts();
  next_ = pair_seed.back() + 1;
}

Adjacency WallCollector::finish(const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                                double negligible) {
  for (; next_ < rows_.end.size(); ++next_) rows_.end[next_] = rows_.walls();
  parts_.clear();
  return match_walls(std::move(rows_), seeds, status, unit, negligible, threads_);
}

}  // namespace powercell
