#include <algorithm>
#include <numeric>

#include "lib/base/threads.hpp"
#include "lib/collect/walls.hpp"

namespace powercell {
namespace {

constexpr std::size_t least_shared_rows = 1024;  // with fewer rows, threads cost more than they save

/// Drops walls of measure 0.
/// \return how many are left
std::size_t settle(const WallRow& row) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < row.count(); ++k) {
    if (row.measures()[k] == 0) continue;
    row.neighbors()[kept] = row.neighbors()[k];
    row.measures()[kept++] = row.measures()[k];
  }
  return kept;
}

/// Replaces ranks by input indices.
void name_neighbors(const WallRow& row, std::size_t count, const SeedSet& seeds, double unit) {
  for (std::size_t k = 0; k < count; ++k) {
    row.neighbors()[k] = seeds.input[row.neighbors()[k]];
    row.measures()[k] *= unit;
  }
}

}  // namespace

Adjacency list_walls(WallRows& rows, const SeedSet& seeds, const WallSelection& selection,
                     const std::vector<SeedStatus>& status, double unit, bool walls, int threads) {
  const auto share = [&](std::size_t count, const auto& body) {
    parallel_for(threads_for(count, threads, least_shared_rows), count, body);
  };
  const Placement* const placement = selection.placement;
  Adjacency out;
  out.offset.assign(status.size() + 1, 0);
  std::vector<std::uint32_t> row_at(status.size(), WallRows::no_rank);
  share(selection.place.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t to = selection.place[k], row = static_cast<std::uint32_t>(k);
      if (status[to] != SeedStatus::ok) continue;
      row_at[to] = row;
      const std::size_t kept = settle(rows.row(row));
      out.offset[to + std::size_t{1}] = kept;
      if (!placement) name_neighbors(rows.row(row), kept, seeds, unit);
    }
  });
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  resize_populated(out.neighbor, out.offset.back(), threads);
  if (walls || placement) resize_populated(out.wall, out.offset.back(), threads);
  if (placement) resize_populated(out.shift, out.offset.back(), threads);
  share(status.size(), [&](std::size_t begin, std::size_t end) {
    std::vector<PlacedWall> placed_walls;
    for (std::size_t to = begin; to < end; ++to) {
      rows.fetch_ahead(row_at, out.offset, to, end);
      if (row_at[to] == WallRows::no_rank) continue;
      const std::uint64_t first = out.offset[to], count = out.offset[to + 1] - first;
      const WallRow from = rows.row(row_at[to]);
      if (placement) {
        placed_walls.clear();
        for (std::size_t k = 0; k < count; ++k)
          placed_walls.push_back(
              placed(*placement, selection.rank[row_at[to]], from.neighbors()[k], from.measures()[k]));
        write_placed(placed_walls, unit, first, out);
      } else if (walls) {
        sort_row(from.neighbors(), from.measures(), count, out.neighbor.data() + first,
                 out.wall.data() + first);
      } else {
        std::copy_n(from.neighbors(), count, out.neighbor.data() + first);
      }
    }
  });
  return out;
}

}  // namespace powercell
