#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "lib/base/threads.hpp"
#include "lib/collect/walls.hpp"

namespace powercell {
namespace {

constexpr std::size_t shared_cells = 4096;  // with fewer ranks, threads cost more than they save

/// Combines the two sides of each wall: that of seed i with seed j in an image, and that of j with i in the
/// opposite one. Both sides become minus their mean, so that the sign tells which walls two cells have.
class PeriodicMatcher {
 public:
  PeriodicMatcher(WallRows& rows, const Placement& placement, const std::vector<SeedStatus>& status,
                  double unit, double negligible, int threads)
      : rows_(rows),
        placement_(placement),
        images_(placement.images),
        unit_(unit),
        negligible_(negligible),
        threads_(threads),
        ok_(images_.own),
        is_moved_(images_.own) {
    for_ranks([&](std::uint32_t rank) {
      is_moved_[rank] = !placement_.is_inside(rank);
      ok_[rank] = status[images_.seeds.input[rank]] == SeedStatus::ok;
    });
  }

  Adjacency run() {
    parallel_for(threads_for(images_.own, threads_, shared_cells), images_.own,
                 [&](std::size_t begin, std::size_t end) {
                   Difference worst;
                   for (std::size_t rank = begin; rank < end; ++rank)
                     match(static_cast<std::uint32_t>(rank), worst);
                   update_worst(worst);
                 });
    settle_one_sided();
    Adjacency out;
    out.offset.assign(images_.seeds.input_count + 1, 0);
    for_ranks([&](std::uint32_t rank) {
      out.offset[std::size_t{images_.seeds.input[rank]} + 1] = kept_walls(rank) + missing_of(rank).size();
    });
    std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
    resize_populated(out.neighbor, out.offset.back(), threads_);
    resize_populated(out.wall, out.offset.back(), threads_);
    resize_populated(out.shift, out.offset.back(), threads_);
    for_ranks([&](std::uint32_t rank) { write_row(rank, out); });
    out.asymmetry = worst_.value * unit_;
    if (worst_.value > 0) out.asymmetric = {images_.seeds.input[worst_.from], images_.seeds.input[worst_.to]};
    return out;
  }

 private:
  /// How much the two sides of a wall differ.
  struct Difference {
    double value = 0;
    std::uint32_t from = 0, to = 0;  // ranks
  };
  /// A wall of a cell that its neighbour does not have, as that neighbour's.
  struct Missing {
    std::uint32_t rank;
    PlacedWall wall;
    bool operator<(const Missing& other) const {
      return rank != other.rank ? rank < other.rank : wall < other.wall;
    }
  };

  template <class Body>
  void for_ranks(const Body& body) const {
    parallel_for(threads_for(images_.own, threads_, shared_cells), images_.own,
                 [&](std::size_t begin, std::size_t end) {
                   for (std::size_t rank = begin; rank < end; ++rank) body(static_cast<std::uint32_t>(rank));
                 });
  }

  void update_worst(const Difference& found) {
    const std::lock_guard lock(mutex_);
    if (found.value > worst_.value || (found.value == worst_.value && found.from < worst_.from))
      worst_ = found;
  }

  /// The wall of the neighbour with this cell in the opposite image, or the number of its walls.
  std::size_t other_side(std::uint32_t rank, std::uint32_t neighbor, const WallRow& row) const {
    std::size_t at = 0;
    if (neighbor < images_.own) {
      while (at < row.count() && row.neighbors()[at] != rank) ++at;
      return at;
    }
    const std::int32_t back = -images_.code[neighbor - images_.own];
    const auto is_back = [&](std::uint32_t image) {
      return image >= images_.own && images_.rank[image - images_.own] == rank &&
             images_.code[image - images_.own] == back;
    };
    while (at < row.count() && !is_back(row.neighbors()[at])) ++at;
    return at;
  }

  /// Matches the walls of which this cell comes first. Walls with seeds without cells become 0.
  void match(std::uint32_t rank, Difference& worst) {
    const WallRow row = rows_.row(rank);
    for (std::size_t k = 0; k < row.count(); ++k) {
      const std::uint32_t neighbor = row.neighbors()[k], j = images_.seed_of(neighbor);
      double& here = row.measures()[k];
      if (!ok_[rank] || !ok_[j]) {
        here = 0;
        continue;
      }
      if (j < rank || (j == rank && images_.code[neighbor - images_.own] > 0)) continue;
      const WallRow there = rows_.row(j);
      const std::size_t other = other_side(rank, neighbor, there);
      if (other == there.count()) continue;
      const double difference = std::fabs(here - there.measures()[other]);
      if (difference > worst.value) worst = {difference, rank, j};
      here = there.measures()[other] = -((here + there.measures()[other]) / 2);
    }
  }

  double largest(std::uint32_t rank) {
    const WallRow row = rows_.row(rank);
    double most = 0;
    for (std::size_t k = 0; k < row.count(); ++k) most = std::max(most, std::fabs(row.measures()[k]));
    return most;
  }

  /// Sets walls to 0 that one cell alone has as rounding, and lists the missing sides of the others.
  void settle_one_sided() {
    const auto settle_row = [&](std::uint32_t rank) {
      const WallRow row = rows_.row(rank);
      for (std::size_t k = 0; k < row.count(); ++k) {
        double& measure = row.measures()[k];
        if (std::signbit(measure) || measure == 0) continue;
        const std::uint32_t neighbor = row.neighbors()[k], j = images_.seed_of(neighbor);
        if (negligible_ > 0 && measure <= negligible_ * std::max(largest(rank), largest(j))) {
          measure = 0;
          continue;
        }
        update_worst({measure, rank, j});
        const std::lock_guard lock(mutex_);
        missing_.push_back(
            {j, {images_.seeds.input[rank], opposite(placement_.shift_of_wall(rank, neighbor)), measure}});
      }
    };
    if (negligible_ > 0)
      for (std::uint32_t rank = 0; rank < images_.own; ++rank) settle_row(rank);  // reads rows of others
    else
      for_ranks(settle_row);
    std::sort(missing_.begin(), missing_.end());
  }

  std::span<const Missing> missing_of(std::uint32_t rank) const {
    const auto [from, end] =
        std::equal_range(missing_.begin(), missing_.end(), Missing{rank, {}},
                         [](const Missing& a, const Missing& b) { return a.rank < b.rank; });
    return {from, end};
  }

  std::uint64_t kept_walls(std::uint32_t rank) {
    const WallRow row = rows_.row(rank);
    return static_cast<std::uint64_t>(std::count_if(row.measures(), row.measures() + row.count(),
                                                    [](double measure) { return measure != 0; }));
  }

  /// Whether some wall of a row may have a shift.
  bool has_shifts(std::uint32_t rank) {
    const WallRow row = rows_.row(rank);
    return is_moved_[rank] || std::any_of(row.neighbors(), row.neighbors() + row.count(),
                                          [&](std::uint32_t j) { return j >= images_.own || is_moved_[j]; });
  }

  void write_row(std::uint32_t rank, Adjacency& out) {
    const WallRow row = rows_.row(rank);
    const std::span<const Missing> missing = missing_of(rank);
    const std::uint64_t to = out.offset[images_.seeds.input[rank]];
    if (missing.empty() && kept_walls(rank) == row.count() && !has_shifts(rank)) {
      for (std::size_t k = 0; k < row.count(); ++k) {
        row.neighbors()[k] = images_.seeds.input[row.neighbors()[k]];
        row.measures()[k] = std::fabs(row.measures()[k]) * unit_;
      }
      sort_row(row.neighbors(), row.measures(), row.count(), out.neighbor.data() + to, out.wall.data() + to);
      return;
    }
    std::vector<PlacedWall> walls;
    for (std::size_t k = 0; k < row.count(); ++k)
      if (row.measures()[k] != 0)
        walls.push_back(placed(placement_, rank, row.neighbors()[k], std::fabs(row.measures()[k])));
    for (const Missing& other : missing) walls.push_back(other.wall);
    write_placed(walls, unit_, to, out);
  }

  WallRows& rows_;
  const Placement& placement_;
  const Images& images_;
  double unit_, negligible_;
  int threads_;
  std::vector<std::uint8_t> ok_;        // by rank of a seed: it has a cell
  std::vector<std::uint8_t> is_moved_;  // by rank of a seed: it was wrapped to another place
  std::mutex mutex_;                    // guards the next two
  Difference worst_;
  std::vector<Missing> missing_;
};

}  // namespace

PlacedWall placed(const Placement& placement, std::uint32_t rank, std::uint32_t neighbor, double measure) {
  return {placement.images.seeds.input[neighbor], placement.shift_of_wall(rank, neighbor), measure};
}

void write_placed(std::vector<PlacedWall>& walls, double unit, std::uint64_t to, Adjacency& out) {
  std::sort(walls.begin(), walls.end());
  for (const PlacedWall& wall : walls) {
    out.neighbor[to] = wall.neighbor;
    out.shift[to] = wall.shift;
    out.wall[to++] = wall.measure * unit;
  }
}

Adjacency match_periodic_walls(WallRows& rows, const Placement& placement,
                               const std::vector<SeedStatus>& status, double unit, double negligible,
                               int threads) {
  return PeriodicMatcher(rows, placement, status, unit, negligible, threads).run();
}

}  // namespace powercell
