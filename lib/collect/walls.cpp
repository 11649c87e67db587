#include "lib/collect/walls.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/layout.h"
#include "lib/seeds/threads.hpp"

namespace powercell {

WallCollector::WallCollector(std::size_t ranks, int threads) : threads_(threads), end_(ranks, 0) {}

void WallCollector::merge(std::vector<Wall>& row) {
  // Sums run in the order of the pairs, so chunks do not change a bit of them.
  std::stable_sort(row.begin(), row.end(),
                   [](const Wall& a, const Wall& b) { return a.neighbor < b.neighbor; });
  std::size_t kept = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    if (kept > 0 && row[kept - 1].neighbor == row[k].neighbor)
      row[kept - 1].measure += row[k].measure;
    else
      row[kept++] = row[k];
  }
  row.resize(kept);
}

void WallCollector::add(std::span<const std::uint32_t> pair_seed, const PieceSet& pieces) {
  std::vector<Wall> current;
  for (std::size_t k = 0; k < pair_seed.size();) {
    const std::uint32_t rank = pair_seed[k];
    for (; open_ < rank; ++open_) end_[open_] = std::max<std::uint64_t>(end_[open_], walls_.size());
    const std::uint64_t begin = rank == 0 ? 0 : end_[rank - 1];
    current.assign(walls_.begin() + static_cast<std::ptrdiff_t>(begin), walls_.end());
    walls_.resize(begin);
    for (; k < pair_seed.size() && pair_seed[k] == rank; ++k) {
      if (pieces.status[k] != PIECE_WHOLE && pieces.status[k] != PIECE_FLAT) continue;
      const PieceBatch& batch = pieces.batches[pieces.batch[k]];
      const std::size_t first = pieces.row[k] * static_cast<std::size_t>(batch.capacity.faces);
      for (std::size_t f = first; f < first + batch.faces[pieces.row[k]]; ++f)
        if (batch.border[f] >= 0)
          current.push_back({static_cast<std::uint32_t>(batch.border[f]), batch.wall[f]});
    }
    merge(current);
    walls_.insert(walls_.end(), current.begin(), current.end());
    end_[rank] = walls_.size();
    open_ = rank;
  }
}

std::span<const WallCollector::Wall> WallCollector::row(std::uint32_t rank) const {
  const std::uint64_t begin = rank == 0 ? 0 : end_[rank - 1];
  return std::span(walls_).subspan(begin, end_[rank] - begin);
}

std::vector<WallCollector::Entry> WallCollector::match(const SeedSet& seeds,
                                                       const std::vector<SeedStatus>& status,
                                                       double negligible, double& asymmetry) const {
  const auto ok = [&](std::uint32_t rank) { return status[seeds.input[rank]] == SeedStatus::ok; };
  const auto largest = [&](std::uint32_t rank) {
    double most = 0;
    for (const Wall& wall : row(rank)) most = std::max(most, wall.measure);
    return most;
  };
  std::vector<Entry> entries;
  entries.reserve(walls_.size() / 2 + 1);
  for (std::uint32_t i = 0; i < end_.size(); ++i) {
    if (!ok(i)) continue;
    for (const Wall& wall : row(i)) {
      const std::uint32_t j = wall.neighbor;
      if (!ok(j)) continue;
      const std::span<const Wall> other = row(j);
      const auto back = std::lower_bound(other.begin(), other.end(), i,
                                         [](const Wall& w, std::uint32_t rank) { return w.neighbor < rank; });
      const bool both = back != other.end() && back->neighbor == i;
      if (both && j < i) continue;  // taken from the other side
      if (both) {
        asymmetry = std::max(asymmetry, std::abs(wall.measure - back->measure));
        entries.push_back({seeds.input[i], seeds.input[j], (wall.measure + back->measure) / 2});
      } else if (wall.measure > negligible * std::max(largest(i), largest(j))) {
        asymmetry = std::max(asymmetry, wall.measure);
        entries.push_back({seeds.input[i], seeds.input[j], wall.measure});
      }
    }
  }
  return entries;
}

Adjacency WallCollector::finish(const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                                double negligible) {
  for (; open_ < end_.size(); ++open_) end_[open_] = std::max<std::uint64_t>(end_[open_], walls_.size());
  Adjacency adjacency;
  double asymmetry = 0;
  std::vector<Entry> entries = match(seeds, status, negligible, asymmetry);
  adjacency.asymmetry = asymmetry * unit;
  walls_ = {};

  adjacency.offset.assign(seeds.input_count + 1, 0);
  for (const Entry& e : entries) {
    ++adjacency.offset[e.a + 1];
    ++adjacency.offset[e.b + 1];
  }
  for (std::size_t i = 0; i < seeds.input_count; ++i) adjacency.offset[i + 1] += adjacency.offset[i];
  std::vector<Wall> rows(entries.size() * 2);
  std::vector<std::uint64_t> at(adjacency.offset.begin(), adjacency.offset.end() - 1);
  for (const Entry& e : entries) {
    rows[at[e.a]++] = {e.b, e.measure};
    rows[at[e.b]++] = {e.a, e.measure};
  }
  entries = {};
  adjacency.neighbor.resize(rows.size());
  adjacency.wall.resize(rows.size());
  parallel_for(threads_, seeds.input_count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto first = static_cast<std::ptrdiff_t>(adjacency.offset[i]);
      const auto last = static_cast<std::ptrdiff_t>(adjacency.offset[i + 1]);
      std::sort(rows.begin() + first, rows.begin() + last,
                [](const Wall& a, const Wall& b) { return a.neighbor < b.neighbor; });
      for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
        adjacency.neighbor[k] = rows[k].neighbor;
        adjacency.wall[k] = rows[k].measure * unit;
      }
    }
  });
  return adjacency;
}

}  // namespace powercell
