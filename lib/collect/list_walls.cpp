#include <algorithm>
#include <numeric>

#include "lib/base/threads.hpp"
#include "lib/collect/walls.hpp"

namespace powercell {
namespace {

constexpr std::size_t least_shared_rows = 1024;  // with fewer rows, threads cost more than they save

/// Replaces ranks by input indices, and drops walls of measure 0. \return how many are left
std::size_t settle(const WallRow& row, const SeedSet& seeds, double unit) {
  std::uint32_t* const neighbor = row.neighbors();
  double* const measure = row.measures();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < row.count(); ++k) {
    if (measure[k] == 0) continue;
    neighbor[kept] = seeds.input[neighbor[k]];
    measure[kept++] = measure[k] * unit;
  }
  return kept;
}

}  // namespace

Adjacency list_walls(WallRows& rows, const SeedSet& seeds, std::span<const std::uint32_t> place,
                     const std::vector<SeedStatus>& status, double unit, bool walls, int threads) {
  const auto for_rows = [&](const auto& body) {
    parallel_for(threads_for(place.size(), threads, least_shared_rows), place.size(),
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t row = begin; row < end; ++row)
                     body(static_cast<std::uint32_t>(row), place[row]);
                 });
  };
  Adjacency out;
  out.offset.assign(status.size() + 1, 0);
  for_rows([&](std::uint32_t row, std::uint32_t to) {
    if (status[to] == SeedStatus::ok) out.offset[to + std::size_t{1}] = settle(rows.row(row), seeds, unit);
  });
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  resize_populated(out.neighbor, out.offset.back(), threads);
  if (walls) resize_populated(out.wall, out.offset.back(), threads);
  for_rows([&](std::uint32_t row, std::uint32_t to) {
    const std::uint64_t first = out.offset[to], count = out.offset[to + std::size_t{1}] - first;
    const WallRow from = rows.row(row);
    if (walls)
      sort_row(from.neighbors(), from.measures(), count, out.neighbor.data() + first,
               out.wall.data() + first);
    else
      std::copy_n(from.neighbors(), count, out.neighbor.data() + first);
  });
  return out;
}

}  // namespace powercell
