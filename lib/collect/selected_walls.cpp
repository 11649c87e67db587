#include "lib/collect/selected_walls.hpp"

#include <algorithm>
#include <numeric>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t shared_rows = 1024;  // with fewer rows, threads cost more than they save
constexpr std::ptrdiff_t few_walls = 40;   // are sorted faster by insertion, without memory

template <class Wall>
void sort_stably(Wall* first, Wall* last) {
  if (last - first > few_walls) return std::stable_sort(first, last);
  for (Wall* next = first; next != last; ++next) {
    const Wall wall = *next;
    Wall* at = next;
    for (; at != first && wall < at[-1]; --at) *at = at[-1];
    *at = wall;
  }
}

}  // namespace

void SelectedWalls::add(std::span<const std::uint32_t> pair_row, std::span<const std::uint32_t> pair_seed,
                        const PieceSet& pieces) {
  for (std::size_t k = 0; k < pair_row.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    const PieceBatch& batch = pieces.batches[pieces.batch[k]];
    const std::uint32_t row = pieces.row[k];
    Row& walls = row_[pair_row[k]];
    if (walls.count == 0) walls.first = walls_.size();
    for (std::uint32_t f = 0; f < batch.faces(row); ++f) {
      const std::int32_t border = batch.borders(row)[f];
      if (border < 0) continue;
      const auto neighbor = static_cast<std::uint32_t>(border);
      walls_.push_back({placement_.images.seeds.input[neighbor],
                        placement_.shift_of_wall(pair_seed[k], neighbor), batch.walls(row)[f]});
    }
    walls.count = walls_.size() - walls.first;
  }
}

void SelectedWalls::settle(Row& row) {
  Wall* const wall = walls_.data() + row.first;
  sort_stably(wall, wall + row.count);  // so that the sums are in the order of the pairs
  std::size_t kept = 0;
  for (std::size_t k = 0; k < row.count;) {
    Wall sum = wall[k];
    for (++k; k < row.count && wall[k].is_with(sum); ++k) sum.measure += wall[k].measure;
    if (sum.measure != 0) wall[kept++] = sum;
  }
  row.count = kept;
}

Adjacency SelectedWalls::finish(std::span<const std::uint32_t> place, const std::vector<SeedStatus>& status,
                                double unit) {
  const auto for_rows = [&](const auto& body) {
    parallel_for(threads_for(row_.size(), threads_, shared_rows), row_.size(),
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t row = begin; row < end; ++row) body(row);
                 });
  };
  Adjacency out;
  out.offset.assign(status.size() + 1, 0);
  for_rows([&](std::size_t row) {
    if (status[place[row]] != SeedStatus::ok) row_[row].count = 0;
    settle(row_[row]);
    out.offset[place[row] + std::size_t{1}] = row_[row].count;
  });
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  out.neighbor.resize(out.offset.back());
  out.wall.resize(out.offset.back());
  out.shift.resize(out.offset.back());
  for_rows([&](std::size_t row) {
    std::uint64_t to = out.offset[place[row]];
    for (std::size_t k = 0; k < row_[row].count; ++k, ++to) {
      const Wall& wall = walls_[row_[row].first + k];
      out.neighbor[to] = wall.neighbor;
      out.wall[to] = wall.measure * unit;
      out.shift[to] = wall.shift;
    }
  });
  return out;
}

}  // namespace powercell
