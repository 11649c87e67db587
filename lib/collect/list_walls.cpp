#include <algorithm>
#include <numeric>

#include "lib/base/threads.hpp"
#include "lib/collect/walls.hpp"

namespace powercell {
namespace {

constexpr std::size_t least_shared_rows = 1024;  // with fewer rows, threads cost more than they save

/// Replaces ranks by input indices, and drops walls of measure 0.
/// \return how many are left
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
  const auto share = [&](std::size_t count, const auto& body) {
    parallel_for(threads_for(count, threads, least_shared_rows), count, body);
  };
  Adjacency out;
  out.offset.assign(status.size() + 1, 0);
  std::vector<std::uint32_t> row_at(status.size(), WallRows::no_rank);
  share(place.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t to = place[k], row = static_cast<std::uint32_t>(k);
      if (status[to] != SeedStatus::ok) continue;
      row_at[to] = row;
      out.offset[to + std::size_t{1}] = settle(rows.row(row), seeds, unit);
    }
  });
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  resize_populated(out.neighbor, out.offset.back(), threads);
  if (walls) resize_populated(out.wall, out.offset.back(), threads);
  share(status.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t to = begin; to < end; ++to) {
      rows.fetch_ahead(row_at, out.offset, to, end);
      if (row_at[to] == WallRows::no_rank) continue;
      const std::uint64_t first = out.offset[to], count = out.offset[to + 1] - first;
      const WallRow from = rows.row(row_at[to]);
      if (walls)
        sort_row(from.neighbors(), from.measures(), count, out.neighbor.data() + first,
                 out.wall.data() + first);
      else
        std::copy_n(from.neighbors(), count, out.neighbor.data() + first);
    }
  });
  return out;
}

}  // namespace powercell
