#include "lib/collect/walls.hpp"

#include <algorithm>

#include "kernels/layout.h"
#include "lib/base/compiler.hpp"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t shared_pairs = 2048;  // with fewer pairs, threads cost more than they save

bool has_walls(const PieceSet& pieces, std::size_t pair) {
  return pieces.status[pair] == PIECE_DONE || pieces.status[pair] == PIECE_FLAT;
}

std::size_t count_walls(const std::int32_t* border, std::size_t count) {
  std::size_t walls = 0;
  for (std::size_t f = 0; f < count; ++f) walls += border[f] >= 0 ? 1 : 0;
  return walls;
}

}  // namespace

WallRows::WallRows(std::size_t ranks, std::size_t parts, Memory memory)
    : place_(ranks), memory_(std::move(memory)) {
  memory_.resize(parts);
  for (GrowingArray<std::uint32_t>& words : memory_) words.resize(0);
  memory_.front().resize(WallRow::words_for(0));
  *memory_.front().data() = 0;
}

void WallRows::fetch_ahead(std::span<const std::uint32_t> rank, std::span<const std::uint64_t> offset,
                           std::size_t i, std::size_t last) {
  constexpr std::size_t place_ahead = 24, row_ahead = 12, line = 64 / sizeof(std::uint32_t);
  if (i + place_ahead < last && rank[i + place_ahead] != no_rank) prefetch(&place_[rank[i + place_ahead]]);
  const std::size_t next = i + row_ahead;
  if (next >= last || rank[next] == no_rank) return;
  const WallRow ahead = row(rank[next]);
  const std::size_t words = WallRow::words_for(offset[next + 1] - offset[next]);
  for (std::size_t word = 0; word < words; word += line) prefetch(ahead.words + word);
  prefetch(ahead.words + words - 1);
}

WallRow WallRows::add(std::size_t part, std::uint32_t rank, std::size_t count) {
  GrowingArray<std::uint32_t>& words = memory_[part];
  const std::size_t first = words.size();
  // Estimates the number of words from the rows so far. Pages that are never written take no memory.
  const double ranks = static_cast<double>(place_.size()), so_far = static_cast<double>(rank) + 1;
  words.resize(first + WallRow::words_for(count), std::clamp(1.05 * ranks / so_far, 1.25, 4.0));
  place_[rank].part = part & 0xffff;
  place_[rank].word = first & 0xffffffffffff;
  words.data()[first] = static_cast<std::uint32_t>(count);
  return {words.data() + first};
}

WallCollector::WallCollector(std::size_t ranks, int threads, WallRows::Memory memory)
    : rows_(ranks, static_cast<std::size_t>(std::max(threads, 1)), std::move(memory)),
      threads_(threads),
      open_rank_(WallRows::no_rank) {}

void WallCollector::reopen(std::uint32_t rank) {
  open_neighbor_.clear();
  open_measure_.clear();
  const WallRow row = rows_.row(rank);
  open_neighbor_.assign(row.neighbors(), row.neighbors() + row.count());
  open_measure_.assign(row.measures(), row.measures() + row.count());
  open_rank_ = open_neighbor_.empty() ? WallRows::no_rank : rank;
}

void WallCollector::divide(std::span<const std::uint32_t> pair_seed) {
  const std::size_t pairs = pair_seed.size();
  const std::size_t wanted = pairs < shared_pairs ? 1 : static_cast<std::size_t>(std::max(threads_, 1));
  parts_.resize(wanted);
  std::size_t begin = 0;
  for (std::size_t p = 0; p < wanted; ++p) {
    Part& part = parts_[p];
    part.begin = begin;
    part.end = std::max(begin, pairs * (p + 1) / wanted);
    while (part.end > 0 && part.end < pairs && pair_seed[part.end] == pair_seed[part.end - 1]) ++part.end;
    begin = part.end;
  }
}

void WallCollector::OpenRow::add(const std::int32_t* border, const double* wall, std::size_t count) {
  if (size + count > neighbor.size()) {
    neighbor.resize(size + count);
    measure.resize(size + count);
  }
  for (std::size_t f = 0; f < count; ++f) {
    neighbor[size] = static_cast<std::uint32_t>(border[f]);  // overwritten by the next one if not a wall
    measure[size] = wall[f];
    size += border[f] >= 0 ? 1 : 0;
  }
}

void WallCollector::add_row(std::size_t part, std::uint32_t rank, const PieceBatch& batch, std::size_t row) {
  const std::int32_t* const border = batch.borders(row);
  const double* const wall = batch.walls(row);
  const std::size_t faces = batch.faces(row), walls = count_walls(border, faces);
  if (walls == 0) return;
  const WallRow made = rows_.add(part, rank, walls);
  std::size_t lower = 0, higher = walls;
  for (std::size_t f = 0; f < faces; ++f) {
    if (border[f] < 0) continue;
    const auto neighbor = static_cast<std::uint32_t>(border[f]);
    const bool is_lower = neighbor < rank;  // unpredictable, so without branches
    higher -= is_lower ? 0 : 1;
    const std::size_t k = is_lower ? lower : higher;
    lower += is_lower ? 1 : 0;
    made.neighbors()[k] = neighbor;
    made.measures()[k] = wall[f];
  }
}

void WallCollector::close_row(std::size_t part, std::uint32_t rank) {
  OpenRow& open = parts_[part].open;
  std::vector<std::uint32_t>& neighbor = parts_[part].neighbor;
  std::vector<double>& measure = parts_[part].measure;
  if (neighbor.size() < open.size) {
    neighbor.resize(open.size);
    measure.resize(open.size);
  }
  std::size_t count = open.size;
  if (sort_row(open.neighbor.data(), open.measure.data(), open.size, neighbor.data(), measure.data())) {
    // Sums are in the order of the pairs, so their bits do not depend on the chunks.
    count = 1;
    for (std::size_t k = 1; k < open.size; ++k) {
      if (neighbor[count - 1] == neighbor[k]) {
        measure[count - 1] += measure[k];
        continue;
      }
      neighbor[count] = neighbor[k];
      measure[count++] = measure[k];
    }
  }
  if (count == 0) return;
  const WallRow row = rows_.add(part, rank, count);
  std::copy_n(neighbor.data(), count, row.neighbors());
  std::copy_n(measure.data(), count, row.measures());
}

void WallCollector::fill(std::size_t part, std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  OpenRow& open = parts_[part].open;
  for (std::size_t k = parts_[part].begin, end = parts_[part].end; k < end;) {
    const std::uint32_t rank = pair_seed[k];
    std::size_t next = k + 1;
    while (next < end && pair_seed[next] == rank) ++next;
    if (next == k + 1 && rank != open_rank_ && !pieces.batches[pieces.batch[k]].repeats) {
      if (has_walls(pieces, k)) add_row(part, rank, pieces.batches[pieces.batch[k]], pieces.row[k]);
      ++k;
      continue;
    }
    open.size = 0;
    if (rank == open_rank_) open.add(open_neighbor_.data(), open_measure_.data(), open_neighbor_.size());
    for (; k < next; ++k) {
      if (!has_walls(pieces, k)) continue;
      const PieceBatch& batch = pieces.batches[pieces.batch[k]];
      const std::size_t row = pieces.row[k];
      open.add(batch.borders(row), batch.walls(row), batch.faces(row));
    }
    close_row(part, rank);
  }
}

void WallCollector::add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  if (pair_seed.empty()) return;
  reopen(pair_seed.front());
  divide(pair_seed);
  parallel_for(static_cast<int>(parts_.size()), parts_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) fill(p, pair_seed, pieces);
  });
}

void WallCollector::set_row(std::uint32_t rank, std::span<const std::uint32_t> neighbors,
                            std::span<const double> measures, std::size_t thread) {
  const WallRow row = rows_.add(thread, rank, neighbors.size());
  std::size_t lower = 0, higher = neighbors.size();
  for (std::size_t f = 0; f < neighbors.size(); ++f) {
    const std::size_t k = neighbors[f] < rank ? lower++ : --higher;
    row.neighbors()[k] = neighbors[f];
    row.measures()[k] = measures[f];
  }
}

void WallCollector::subtract(std::uint32_t rank, std::uint32_t neighbor, double measure) {
  constexpr double rounding = 0x1p-36;  // relative
  const WallRow row = rows_.row(rank);
  for (std::size_t k = 0; k < row.count(); ++k) {
    if (row.neighbors()[k] != neighbor) continue;
    double& wall = row.measures()[k];
    wall = wall - measure > rounding * wall ? wall - measure : 0;
  }
}

Adjacency WallCollector::finish_selected(const SeedSet& seeds, const WallSelection& selection,
                                         const std::vector<SeedStatus>& status, double unit, bool walls) {
  parts_.clear();
  return list_walls(rows_, seeds, selection, status, unit, walls, threads_);
}

Adjacency WallCollector::finish(const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                                double negligible) {
  parts_.clear();
  return match_walls(rows_, seeds, status, unit, negligible, threads_);
}

Adjacency WallCollector::finish(const Placement& placement, const std::vector<SeedStatus>& status,
                                double unit, double negligible) {
  parts_.clear();
  return match_periodic_walls(rows_, placement, status, unit, negligible, threads_);
}

}  // namespace powercell
