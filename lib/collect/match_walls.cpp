#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>
#include <tuple>

#include "lib/base/compiler.hpp"
#include "lib/base/threads.hpp"
#include "lib/base/vector_copies.hpp"
#include "lib/collect/walls.hpp"

namespace powercell {
namespace {

constexpr std::size_t shared_ranks = 4096;  // with fewer ranks, threads cost more than they save

// A vector of the compiler, which does not vectorise such short loops by itself.
using Vector POWERCELL_VECTOR(WallRow::lanes * sizeof(std::uint32_t)) = std::uint32_t;
static_assert(WallRow::lanes == 8);

/// The place of neighbour i in a row, or the row's count. Uses no unpredictable branches, and whole vectors,
/// which may extend beyond the neighbours.
POWERCELL_ALWAYS_INLINE std::size_t find(const WallRow& row, std::uint32_t i) {
  const auto count = static_cast<std::uint32_t>(row.count());
  Vector place = {}, here = {1, 2, 3, 4, 5, 6, 7, 8};  // counted from 1
  for (std::uint32_t block = 0; block < count; block += WallRow::lanes, here += WallRow::lanes) {
    Vector neighbor;
    std::memcpy(&neighbor, row.neighbors() + block, sizeof neighbor);
    place |= ((neighbor == i) & (here <= count)) ? here : Vector{};
  }
  std::uint32_t found = 0;
  for (std::uint32_t lane = 0; lane < WallRow::lanes; ++lane) found |= place[lane];
  return found == 0 ? count : found - 1;
}

/// How much the two sides of a wall differ.
struct Difference {
  double value = 0;
  std::uint32_t from = 0, to = 0;  // ranks

  /// Keeps the larger one. Of equal ones the result does not depend on the order of calls.
  void update(const Difference& other) {
    const auto order = [](const Difference& d) { return std::tuple(-d.value, d.from, d.to); };
    if (order(other) < order(*this)) *this = other;
  }
};

/// Replaces both sides of a wall by their mean, with the sign bit set to mark the wall as two-sided. The
/// lower rank of a pair does so, and so threads write to different places. Returns the largest difference; of
/// equal ones that of the lowest rank, and there of the highest neighbour.
POWERCELL_VECTOR_COPIES
Difference average_rows(WallRows& rows, const std::vector<std::uint8_t>& ok, std::uint32_t first,
                        std::uint32_t last) {
  Difference worst;
  for (std::uint32_t i = first; i < last; ++i) {
    if (!ok[i]) continue;
    const WallRow row = rows.row(i);
    for (std::size_t k = row.count(); k-- > 0 && row.neighbors()[k] > i;) {
      const std::uint32_t j = row.neighbors()[k];
      if (!ok[j]) continue;
      const WallRow other = rows.row(j);
      const std::size_t back = find(other, i);
      if (back == other.count()) continue;
      double &here = row.measures()[k], &there = other.measures()[back];
      const double difference = std::abs(here - there);
      if (difference > worst.value) worst = {difference, i, j};
      here = there = -((here + there) / 2);
    }
  }
  return worst;
}

/// Combines the two sides of each wall; threads share the seeds.
class WallMatcher {
 public:
  WallMatcher(WallRows& rows, const SeedSet& seeds, const std::vector<SeedStatus>& status, double unit,
              double negligible, int threads)
      : rows_(rows),
        seeds_(seeds),
        unit_(unit),
        negligible_(negligible),
        threads_(seeds.size() < shared_ranks ? 1 : threads),
        ok_(seeds.size()),
        largest_(negligible > 0 ? seeds.size() : 0),
        rank_(seeds.input_count, WallRows::no_rank) {
    for_ranks([&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t i = begin; i < end; ++i) {
        ok_[i] = status[seeds.input[i]] == SeedStatus::ok;
        if (ok_[i]) rank_[seeds.input[i]] = i;
        if (negligible > 0) largest_[i] = largest(i);
      }
    });
  }

  Adjacency run() {
    for_ranks([this](std::uint32_t begin, std::uint32_t end) { average(begin, end); });
    resize_populated(out_.offset, seeds_.input_count + 1, threads_);
    for_ranks([this](std::uint32_t begin, std::uint32_t end) { finish_rows(begin, end); });
    std::sort(one_sided_.begin(), one_sided_.end());
    for (const OneSided& wall : one_sided_) ++out_.offset[seeds_.input[wall.to] + 1];
    std::partial_sum(out_.offset.begin(), out_.offset.end(), out_.offset.begin());
    resize_populated(out_.neighbor, out_.offset.back(), threads_);
    resize_populated(out_.wall, out_.offset.back(), threads_);
    parallel_for(threads_, seeds_.input_count,
                 [this](std::size_t begin, std::size_t end) { write(begin, end); });
    out_.asymmetry = worst_.value * unit_;
    if (worst_.value > 0) out_.asymmetric = {seeds_.input[worst_.from], seeds_.input[worst_.to]};
    return std::move(out_);
  }

 private:
  /// A wall of `from` with `to` that `to` does not have.
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

  double largest(std::uint32_t rank) {
    const WallRow row = rows_.row(rank);
    return row.count() == 0 ? 0 : *std::max_element(row.measures(), row.measures() + row.count());
  }

  void average(std::uint32_t first, std::uint32_t last) {
    const Difference worst = average_rows(rows_, ok_, first, last);
    const std::lock_guard lock(mutex_);
    worst_.update(worst);
  }

  /// Drops walls, and replaces ranks by input indices and measures by final ones, in place. Sets the lengths
  /// of the rows, one-sided walls of other cells not included.
  void finish_rows(std::uint32_t first, std::uint32_t last) {
    std::vector<OneSided> alone;
    for (std::uint32_t i = first; i < last; ++i) {
      if (!ok_[i]) continue;
      const WallRow row = rows_.row(i);
      const auto both = std::count_if(row.measures(), row.measures() + row.count(),
                                      [](double measure) { return measure < 0; });
      if (static_cast<std::size_t>(both) < row.count()) drop_walls(i, alone);
      for (std::size_t k = 0; k < row.count(); ++k) {
        row.neighbors()[k] = seeds_.input[row.neighbors()[k]];
        row.measures()[k] = std::abs(row.measures()[k]) * unit_;
      }
      out_.offset[seeds_.input[i] + 1] = row.count();
    }
    const std::lock_guard lock(mutex_);
    one_sided_.insert(one_sided_.end(), alone.begin(), alone.end());
    for (const OneSided& wall : alone) worst_.update({wall.measure / unit_, wall.from, wall.to});
  }

  /// Drops the negligible walls of a row, and appends its one-sided ones to `alone`.
  void drop_walls(std::uint32_t i, std::vector<OneSided>& alone) {
    const WallRow row = rows_.row(i);
    std::vector<std::uint32_t> neighbor;
    std::vector<double> measure;
    for (std::size_t k = 0; k < row.count(); ++k) {
      const std::uint32_t j = row.neighbors()[k];
      const double here = row.measures()[k];
      if (here == 0) continue;  // two-sided, of measure 0
      if (!std::signbit(here)) {
        if (!ok_[j]) continue;
        if (negligible_ > 0 && !(here > negligible_ * std::max(largest_[i], largest_[j]))) continue;
        alone.push_back({j, i, here * unit_});
      }
      neighbor.push_back(j);
      measure.push_back(here);
    }
    row.words[0] = static_cast<std::uint32_t>(neighbor.size());
    std::copy(neighbor.begin(), neighbor.end(), row.neighbors());
    std::copy(measure.begin(), measure.end(), row.measures());
  }

  /// Writes the rows of the input indices [first, last) to the result.
  void write(std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      rows_.fetch_ahead(rank_, out_.offset, i, last);
      if (rank_[i] == WallRows::no_rank) continue;
      const WallRow row = rows_.row(rank_[i]);
      std::uint32_t* const neighbor = out_.neighbor.data() + out_.offset[i];
      double* const wall = out_.wall.data() + out_.offset[i];
      if (out_.offset[i + 1] - out_.offset[i] == row.count())
        sort_row(row.neighbors(), row.measures(), row.count(), neighbor, wall);
      else
        write_with_one_sided(row, rank_[i], neighbor, wall);
    }
  }

  /// Writes a row together with the one-sided walls that other cells have with this one.
  void write_with_one_sided(const WallRow& row, std::uint32_t rank, std::uint32_t* neighbor, double* wall) {
    std::vector<std::uint32_t> neighbors(row.neighbors(), row.neighbors() + row.count());
    std::vector<double> measures(row.measures(), row.measures() + row.count());
    for (auto extra = std::lower_bound(one_sided_.begin(), one_sided_.end(), OneSided{rank, 0, 0});
         extra != one_sided_.end() && extra->to == rank; ++extra) {
      neighbors.push_back(seeds_.input[extra->from]);
      measures.push_back(extra->measure);
    }
    sort_row(neighbors.data(), measures.data(), neighbors.size(), neighbor, wall);
  }

  WallRows& rows_;
  const SeedSet& seeds_;
  double unit_, negligible_;
  int threads_;
  std::vector<std::uint8_t> ok_;     // by rank
  std::vector<double> largest_;      // by rank: the largest wall; empty unless negligible_ > 0
  std::vector<std::uint32_t> rank_;  // by input index; no_rank if the cell is empty
  std::mutex mutex_;                 // guards the next two
  Difference worst_;
  std::vector<OneSided> one_sided_;
  Adjacency out_;
};

}  // namespace

Adjacency match_walls(WallRows& rows, const SeedSet& seeds, const std::vector<SeedStatus>& status,
                      double unit, double negligible, int threads) {
  return WallMatcher(rows, seeds, status, unit, negligible, threads).run();
}

}  // namespace powercell
