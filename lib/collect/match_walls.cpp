#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "lib/collect/sort_row.hpp"
#include "lib/collect/walls.hpp"
#include "lib/seeds/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t share_count = 4096;  // ranks; below, threads cost more than they save

/// Brings the two sides of each wall together, with the seeds shared between threads.
class WallMatcher {
 public:
  WallMatcher(WallRows rows, const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
              double negligible, int threads)
      : rows_(std::move(rows)),
        seeds_(seeds),
        unit_(unit),
        negligible_(negligible),
        threads_(seeds.size() < share_count ? 1 : threads),
        ok_(seeds.size()),
        rank_(seeds.input_count, no_rank) {
    for_ranks([&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) {
        ok_[i] = status[seeds.input[i]] == SeedStatus::ok;
        if (ok_[i]) rank_[seeds.input[i]] = i;
      }
    });
  }

  Adjacency run() {
    for_ranks([this](std::uint32_t begin, std::uint32_t end) { average(begin, end); });
    out_.offset.assign(seeds_.input_count + 1, 0);
    for_ranks([this](std::uint32_t begin, std::uint32_t end) { finish_rows(begin, end); });
    std::sort(one_sided_.begin(), one_sided_.end());
    for (const OneSided& wall : one_sided_) ++out_.offset[seeds_.input[wall.to] + 1];
    std::partial_sum(out_.offset.begin(), out_.offset.end(), out_.offset.begin());
    out_.neighbor.resize(out_.offset.back());
    out_.wall.resize(out_.offset.back());
    parallel_for(threads_, seeds_.input_count,
                 [this](std::size_t begin, std::size_t end) { write(begin, end); });
    out_.asymmetry = asymmetry_ * unit_;
    return std::move(out_);
  }

 private:
  /// A wall that `from` has with `to`, and `to` not with `from`.
  struct OneSided {
    std::uint32_t to, from;  // ranks
    double measure;          // in the caller's unit
    bool operator<(const OneSided& other) const { return to != other.to ? to < other.to : from < other.from; }
  };

  template <class Body>
  void for_ranks(const Body& body) {
    parallel_for(threads_, seeds_.size(), [&](std::size_t begin, std::size_t end) {
      body(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
    });
  }

  /// Where a row has neighbour i, or its count.
  static std::size_t find(const WallRow& row, std::uint32_t i) {
    if (row.count == 0) return row.count;
    // The last entry that is not above i, by steps without branches.
    std::size_t at = 0;
    for (std::size_t count = row.count; count > 1; count -= count / 2)
      at += row.neighbor[at + count / 2] <= i ? count / 2 : 0;
    return row.neighbor[at] == i ? at : row.count;
  }

  /// Walls that both sides have get the mean, and the sign bit, which no measure has before. Each pair is met
  /// once, by its lower rank, so that threads write to different places, whatever rows those are in.
  void average(std::uint32_t first, std::uint32_t last) {
    double worst = 0;
    for (std::uint32_t i = first; i < last; ++i) {
      if (!ok_[i]) continue;
      const WallRow row = rows_.row(i);
      for (std::size_t k = row.count; k-- > 0 && row.neighbor[k] > i;) {
        const std::uint32_t j = row.neighbor[k];
        if (!ok_[j]) continue;
        const WallRow other = rows_.row(j);
        const std::size_t back = find(other, i);
        if (back == other.count) continue;
        const double here = row.measure(k), there = other.measure(back);
        worst = std::max(worst, std::abs(here - there));
        row.set_measure(k, -((here + there) / 2));
        other.set_measure(back, -((here + there) / 2));
      }
    }
    const std::lock_guard lock(mutex_);
    asymmetry_ = std::max(asymmetry_, worst);
  }

  /// Brings rows into their final form where they are: without what is dropped, by input index and in its
  /// order. Sets how long they are, without what only the other side has.
  void finish_rows(std::uint32_t first, std::uint32_t last) {
    double worst = 0;
    std::vector<OneSided> alone;
    std::vector<std::uint32_t> neighbor;
    std::vector<double> wall, sorted;
    for (std::uint32_t i = first; i < last; ++i) {
      if (!ok_[i]) continue;
      WallRow row = rows_.row(i);
      if (neighbor.size() < row.count) {
        neighbor.resize(row.count);
        wall.resize(row.count);
        sorted.resize(row.count);
      }
      std::size_t kept = 0;
      for (std::size_t k = 0; k < row.count; ++k) {
        const std::uint32_t j = row.neighbor[k];
        const double measure = row.measure(k);
        if (measure == 0) continue;  // a tie without extent, on both sides
        if (!std::signbit(measure)) {
          if (!ok_[j] || !(measure > negligible_ * std::max(rows_.largest[i], rows_.largest[j]))) continue;
          worst = std::max(worst, measure);
          alone.push_back({j, i, measure * unit_});
        }
        neighbor[kept] = seeds_.input[j];
        wall[kept++] = std::abs(measure) * unit_;
      }
      sort_row(neighbor.data(), wall.data(), kept, row.neighbor, sorted.data());
      if (kept > 0) std::memcpy(row.neighbor + kept, sorted.data(), kept * sizeof(double));
      out_.offset[seeds_.input[i] + 1] = kept;
    }
    const std::lock_guard lock(mutex_);
    asymmetry_ = std::max(asymmetry_, worst);
    one_sided_.insert(one_sided_.end(), alone.begin(), alone.end());
  }

  /// Rows come from all over the memory: those of the seeds to come are asked for ahead.
  void fetch_ahead(std::size_t i, std::size_t last) {
    constexpr std::size_t end_ahead = 24, row_ahead = 12, line = 16;
    if (i + end_ahead < last && rank_[i + end_ahead] != no_rank) prefetch(&rows_.end[rank_[i + end_ahead]]);
    if (i + row_ahead >= last || rank_[i + row_ahead] == no_rank) return;
    const WallRow row = rows_.row(rank_[i + row_ahead]);
    for (std::size_t word = 0; word < row.count * WallRows::words_per_wall; word += line)
      prefetch(row.neighbor + word);
  }

  /// Rows of the result for the input indices [first, last).
  void write(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      fetch_ahead(i, last);
      if (rank_[i] == no_rank) continue;
      const auto extra = std::lower_bound(one_sided_.begin(), one_sided_.end(), OneSided{rank_[i], 0, 0});
      auto extra_end = extra;
      while (extra_end != one_sided_.end() && extra_end->to == rank_[i]) ++extra_end;
      const auto extras = static_cast<std::size_t>(extra_end - extra);
      const std::uint64_t begin = out_.offset[i], count = out_.offset[i + 1] - begin - extras;
      const std::uint32_t* const row = rows_.row(rank_[i]).neighbor;
      std::copy_n(row, count, out_.neighbor.data() + begin);
      if (count > 0) std::memcpy(out_.wall.data() + begin, row + count, count * sizeof(double));
      if (extras > 0) add_extras(begin, count, std::span(extra, extras));
    }
  }

  /// Puts what only other cells have with this one into its row, which begins at `begin` of the result.
  void add_extras(std::uint64_t begin, std::size_t count, std::span<const OneSided> extras) {
    std::uint32_t* const neighbor = &out_.neighbor[begin];
    double* const wall = &out_.wall[begin];
    for (const OneSided& extra : extras) {
      neighbor[count] = seeds_.input[extra.from];
      wall[count++] = extra.measure;
    }
    sort_row(std::vector(neighbor, neighbor + count).data(), std::vector(wall, wall + count).data(), count,
             neighbor, wall);
  }

  WallRows rows_;
  const SeedSet& seeds_;
  double unit_, negligible_;
  int threads_;
  std::vector<std::uint8_t> ok_;  // by rank
  static constexpr std::uint32_t no_rank = ~std::uint32_t{0};
  std::vector<std::uint32_t> rank_;  // by input index, no_rank where the cell is empty
  std::mutex mutex_;                 // guards the two below while ranks are shared
  double asymmetry_ = 0;
  std::vector<OneSided> one_sided_;
  Adjacency out_;
};

}  // namespace

Adjacency match_walls(WallRows rows, const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
                      double negligible, int threads) {
  return WallMatcher(std::move(rows), seeds, status, unit, negligible, threads).run();
}

}  // namespace powercell
