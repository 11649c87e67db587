#include "lib/diagram/merge_rows.hpp"

#include <algorithm>
#include <numeric>
#include <powercell/error.hpp>
#include <string>

namespace powercell {
namespace {

constexpr std::uint32_t not_listed = ~std::uint32_t{0};

struct Wall {
  std::uint32_t neighbor;
  Shift shift;
  double measure;
  bool operator<(const Wall& other) const {
    return neighbor != other.neighbor ? neighbor < other.neighbor : shift < other.shift;
  }
};

Shift opposite(const Shift& shift) {
  return {-shift[0], -shift[1], -shift[2]};
}

/// The walls of listed cells by row, those of the rows of their neighbours too.
class NewWalls {
 public:
  NewWalls(std::span<const std::uint32_t> listed, const Adjacency& exact, const std::vector<bool>& has_cell)
      : listed_(listed), exact_(exact), has_cell_(has_cell), row_(has_cell.size(), not_listed) {
    const std::size_t n = has_cell.size();
    for (std::uint32_t row = 0; row < listed.size(); ++row) row_[listed[row]] = row;
    begin_.assign(n + 1, 0);
    for_each([this](std::uint32_t i, const Wall&) { ++begin_[i + 1]; });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    walls_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for_each([&](std::uint32_t i, const Wall& wall) { walls_[next[i]++] = wall; });
    for (std::size_t i = 0; i < n; ++i)
      std::sort(walls_.begin() + static_cast<std::ptrdiff_t>(begin_[i]),
                walls_.begin() + static_cast<std::ptrdiff_t>(begin_[i + 1]));
  }

  bool is_listed(std::uint32_t seed) const { return row_[seed] != not_listed; }
  std::span<const Wall> row(std::uint32_t seed) const {
    return std::span(walls_).subspan(begin_[seed], begin_[seed + 1] - begin_[seed]);
  }

 private:
  /// Calls add(i, wall of i) for both sides of each wall.
  template <class Add>
  void for_each(const Add& add) const {
    for (const std::uint32_t i : listed_) {
      if (!has_cell_[i]) continue;
      const std::uint32_t row = row_[i];
      for (std::uint64_t k = exact_.offset[row]; k < exact_.offset[row + 1]; ++k) {
        const std::uint32_t j = exact_.neighbor[k];
        if (!has_cell_[j]) continue;
        const Shift shift = exact_.shift.empty() ? Shift{} : exact_.shift[k], back = opposite(shift);
        const double here = exact_.wall[k], *there = side_of(j, i, back);
        add(i, {j, shift, there ? (here + *there) / 2 : here});
        if (!there) add(j, {i, back, here});  // else it is added as a wall of j
      }
    }
  }

  /// The wall of a listed cell with an image of another one, or null if it is not listed or has none.
  const double* side_of(std::uint32_t cell, std::uint32_t neighbor, const Shift& shift) const {
    if (!is_listed(cell)) return nullptr;
    const auto begin = exact_.neighbor.begin() + static_cast<std::ptrdiff_t>(exact_.offset[row_[cell]]),
               end = exact_.neighbor.begin() + static_cast<std::ptrdiff_t>(exact_.offset[row_[cell] + 1]);
    for (auto at = std::lower_bound(begin, end, neighbor); at != end && *at == neighbor; ++at) {
      const auto k = static_cast<std::size_t>(at - exact_.neighbor.begin());
      if (exact_.shift.empty() || exact_.shift[k] == shift) return &exact_.wall[k];
    }
    return nullptr;
  }

  std::span<const std::uint32_t> listed_;
  const Adjacency& exact_;
  const std::vector<bool>& has_cell_;
  std::vector<std::uint32_t> row_;  // by seed: its row of `exact`
  std::vector<std::size_t> begin_;  // by seed
  std::vector<Wall> walls_;
};

template <class Real>
void append(DeviceRows<Real>& rows, const Wall& wall, Real measure) {
  rows.neighbor.push_back(wall.neighbor);
  rows.wall.push_back(measure);
  if (rows.has_shifts) rows.shift.push_back(wall.shift);
}

/// Appends the row of cell i: its walls with cells that are not listed, and those of listed ones.
template <class Real>
void append_row(const DeviceRows<Real>& all, const NewWalls& walls, std::uint32_t i,
                DeviceRows<Real>& merged) {
  const std::span<const Wall> added = walls.row(i);
  auto next = added.begin();
  const std::uint32_t end = walls.is_listed(i) ? all.offset[i] : all.offset[i + 1];
  for (std::uint32_t k = all.offset[i]; k < end; ++k) {
    if (walls.is_listed(all.neighbor[k])) continue;
    const Wall kept{all.neighbor[k], all.has_shifts ? all.shift[k] : Shift{}, 0};
    for (; next != added.end() && *next < kept; ++next)
      append(merged, *next, static_cast<Real>(next->measure));
    append(merged, kept, all.wall[k]);
  }
  for (; next != added.end(); ++next) append(merged, *next, static_cast<Real>(next->measure));
  merged.offset.push_back(static_cast<std::uint32_t>(merged.neighbor.size()));
}

}  // namespace

template <class Real>
DeviceRows<Real> merge_rows(const DeviceRows<Real>& all, std::span<const std::uint32_t> listed,
                            const Adjacency& exact, const std::vector<bool>& has_cell, std::uint32_t room) {
  const NewWalls walls(listed, exact, has_cell);
  DeviceRows<Real> merged;
  merged.has_shifts = all.has_shifts;
  merged.offset.reserve(all.offset.size());
  merged.neighbor.reserve(all.neighbor.size());
  merged.wall.reserve(all.wall.size());
  merged.offset.push_back(0);
  for (std::uint32_t i = 0; i < has_cell.size(); ++i) append_row(all, walls, i, merged);
  if (merged.neighbor.size() > room)
    throw Error(ErrorCode::invalid_argument,
                "the repaired adjacency has " + std::to_string(merged.neighbor.size()) +
                    " entries, and the buffers of neighbors and walls have room for " + std::to_string(room) +
                    "; enqueue the diagram again with larger ones, and repair that");
  return merged;
}

template DeviceRows<float> merge_rows(const DeviceRows<float>&, std::span<const std::uint32_t>,
                                      const Adjacency&, const std::vector<bool>&, std::uint32_t);
template DeviceRows<double> merge_rows(const DeviceRows<double>&, std::span<const std::uint32_t>,
                                       const Adjacency&, const std::vector<bool>&, std::uint32_t);

}  // namespace powercell
