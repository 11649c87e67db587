#include "lib/out_of_core/gather.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "lib/base/background.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/sums.hpp"

namespace powercell::out_of_core {
namespace {

/// Where the next cell of a piece is.
struct Cursor {
  std::size_t cell = 0, wall = 0;
};

class Gatherer {
 public:
  Gatherer(const std::vector<PieceFile>& pieces, int dimension, double domain_measure)
      : pieces_(pieces),
        cursors_(pieces.size()),
        d_(static_cast<std::size_t>(dimension)),
        domain_measure_(domain_measure) {
    for (const PieceFile& piece : pieces) {
      all_walls_ += piece.all_walls;
      has_walls_ = has_walls_ || !piece.neighbor.empty();
      has_shifts_ = has_shifts_ || !piece.shift.empty();
    }
  }

  CellRows rows(std::uint64_t first, std::size_t count) {
    CellRows rows = empty(first, count);
    const std::vector<Cursor> begin = cursors_;
    for (std::size_t p = 0; p < pieces_.size(); ++p) take_cells(p, rows);
    std::partial_sum(rows.offset.begin(), rows.offset.end(), rows.offset.begin());
    if (has_walls_) {
      rows.neighbor.resize(rows.offset.back());
      rows.wall.resize(rows.offset.back());
    }
    if (has_shifts_) rows.shift.resize(rows.offset.back());
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      if (has_walls_) take_walls(p, begin[p], rows);
      pieces_[p].drop();
    }
    return rows;
  }

 private:
  /// As if all seeds were duplicates.
  CellRows empty(std::uint64_t first, std::size_t count) const {
    CellRows rows;
    rows.first = first;
    rows.all_walls = all_walls_;
    Measures& measures = rows.measures;
    measures.dimension = static_cast<int>(d_);
    measures.domain_measure = domain_measure_;
    measures.mass.resize(count);
    measures.centroid.resize(count * d_, std::numeric_limits<double>::quiet_NaN());
    measures.second_moment.resize(count);
    measures.status.resize(count, SeedStatus::duplicate);
    rows.offset.resize(count + 1);
    return rows;
  }

  void take_cells(std::size_t p, CellRows& rows) {
    const PieceFile& piece = pieces_[p];
    Cursor& at = cursors_[p];
    Measures& to = rows.measures;
    const std::uint64_t end = rows.first + to.mass.size();
    for (; at.cell < piece.size() && piece.id[at.cell] < end; ++at.cell) {
      const std::size_t row = piece.id[at.cell] - rows.first;
      to.mass[row] = piece.mass[at.cell];
      copy_point(&piece.centroid[at.cell * d_], d_, &to.centroid[row * d_]);
      to.second_moment[row] = piece.second_moment[at.cell];
      to.status[row] = piece.status[at.cell];
      rows.offset[row + 1] = piece.walls[at.cell];
      at.wall += piece.walls[at.cell];
    }
  }

  void take_walls(std::size_t p, Cursor from, CellRows& rows) const {
    const PieceFile& piece = pieces_[p];
    for (; from.cell < cursors_[p].cell; ++from.cell) {
      const std::size_t count = piece.walls[from.cell];
      if (count == 0) continue;
      const std::uint64_t to = rows.offset[piece.id[from.cell] - rows.first];
      std::copy_n(&piece.neighbor[from.wall], count, &rows.neighbor[to]);
      std::copy_n(&piece.wall[from.wall], count, &rows.wall[to]);
      if (has_shifts_) std::copy_n(&piece.shift[from.wall], count, &rows.shift[to]);
      from.wall += count;
    }
  }

  const std::vector<PieceFile>& pieces_;
  std::vector<Cursor> cursors_;
  std::size_t d_;
  double domain_measure_;
  std::uint64_t all_walls_ = 0;
  bool has_walls_ = false, has_shifts_ = false;  // written in the pieces
};

}  // namespace

void gather(const std::vector<PieceFile>& pieces, std::uint64_t seeds, int dimension, double domain_measure,
            std::size_t rows, const std::function<void(CellRows)>& take, Traffic& traffic,
            OutOfCoreReport& report) {
  Gatherer gatherer(pieces, dimension, domain_measure);
  CompensatedSum<double> sum;
  const auto make = [&](std::size_t k) {
    const std::uint64_t first = std::uint64_t{k} * rows;
    return gatherer.rows(first, std::min<std::uint64_t>(rows, seeds - first));
  };
  const auto use = [&](CellRows&& cells) {
    for (const double mass : cells.measures.mass) sum.add(mass);
    report.cells += cells.measures.count(SeedStatus::ok);
    report.hidden += cells.measures.count(SeedStatus::hidden);
    report.duplicate += cells.measures.count(SeedStatus::duplicate);
    traffic.progress(static_cast<double>(cells.first) / static_cast<double>(seeds));
    take(std::move(cells));
  };
  make_ahead((seeds + rows - 1) / rows, make, use);
  for (const PieceFile& piece : pieces) traffic.read += piece.bytes();
  report.measure = sum.value();
  report.domain_measure = domain_measure;
}

}  // namespace powercell::out_of_core
