#include "lib/applications/density/cell_integrals.hpp"

#include <algorithm>
#include <numeric>

#include "lib/base/threads.hpp"

namespace powercell {
namespace {

constexpr std::size_t most_cells_a_task = 64;  // enough to make taking a task cheap

/// Calls `body(integrator, i)` for every cell i, in parallel.
template <class Body>
void for_cells(std::size_t count, const MakeIntegrator& make, int threads, const Body& body) {
  const auto workers = static_cast<std::size_t>(std::max(threads, 1));
  std::vector<std::unique_ptr<PieceIntegrator>> integrators(workers);
  // Few cells may take long each, so they are shared out finely.
  const std::size_t cells_a_task = std::clamp<std::size_t>(count / (8 * workers), 1, most_cells_a_task);
  parallel_tasks(threads, (count + cells_a_task - 1) / cells_a_task, [&](int worker, std::size_t task) {
    std::unique_ptr<PieceIntegrator>& own = integrators[static_cast<std::size_t>(worker)];
    if (!own) own = make();
    const std::size_t end = std::min(count, (task + 1) * cells_a_task);
    for (std::size_t i = task * cells_a_task; i < end; ++i) body(*own, i);
  });
}

/// The neighbours of each cell, ascending and distinct.
class Rows {
 public:
  Rows(const Cells& cells, std::span<const SeedStatus> status) {
    offset_ = {0};
    for (std::size_t i = 0; i < cells.cell_count(); ++i) {
      const auto begin = static_cast<std::ptrdiff_t>(neighbor_.size());
      for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p)
        for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
          const Border& border = cells.border[f];
          if (border.kind == Border::Kind::wall && status[border.index] == SeedStatus::ok)
            neighbor_.push_back(border.index);
        }
      std::sort(neighbor_.begin() + begin, neighbor_.end());
      neighbor_.erase(std::unique(neighbor_.begin() + begin, neighbor_.end()), neighbor_.end());
      offset_.push_back(neighbor_.size());
    }
  }
  static constexpr std::uint64_t none = ~std::uint64_t{0};
  /// Position of j in row i.
  std::uint64_t find(std::size_t i, std::uint32_t j) const {
    const auto begin = neighbor_.begin() + static_cast<std::ptrdiff_t>(offset_[i]);
    const auto end = neighbor_.begin() + static_cast<std::ptrdiff_t>(offset_[i + 1]);
    const auto at = std::lower_bound(begin, end, j);
    return at != end && *at == j ? static_cast<std::uint64_t>(at - neighbor_.begin()) : none;
  }
  const std::vector<std::uint64_t>& offset() const { return offset_; }
  const std::vector<std::uint32_t>& neighbor() const { return neighbor_; }

 private:
  std::vector<std::uint64_t> offset_;
  std::vector<std::uint32_t> neighbor_;
};

/// Rows of a symmetric matrix, from values stored for one side of each pair. Drops walls of measure 0.
Adjacency both_sides(const Rows& rows, const std::vector<double>& value) {
  Adjacency out;
  const std::size_t n = rows.offset().size() - 1;
  out.offset.assign(n + 1, 0);
  const auto for_pairs = [&](const auto& body) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::uint64_t k = rows.offset()[i]; k < rows.offset()[i + 1]; ++k)
        if (value[k] > 0) body(static_cast<std::uint32_t>(i), rows.neighbor()[k], value[k]);
  };
  for_pairs([&](std::uint32_t i, std::uint32_t j, double) {
    ++out.offset[i + 1];
    ++out.offset[j + 1];
  });
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  std::vector<std::pair<std::uint32_t, double>> entry(out.offset.back());
  std::vector<std::uint64_t> at(out.offset.begin(), out.offset.end() - 1);
  for_pairs([&](std::uint32_t i, std::uint32_t j, double wall) {
    entry[at[i]++] = {j, wall};
    entry[at[j]++] = {i, wall};
  });
  for (std::size_t i = 0; i < n; ++i)
    std::sort(entry.begin() + static_cast<std::ptrdiff_t>(out.offset[i]),
              entry.begin() + static_cast<std::ptrdiff_t>(out.offset[i + 1]));
  for (const auto& [j, wall] : entry) {
    out.neighbor.push_back(j);
    out.wall.push_back(wall);
  }
  return out;
}

}  // namespace

std::vector<Moments> cell_moments(const Cells& cells, const DomainBox& box, const MakeIntegrator& make,
                                  int threads) {
  std::vector<Moments> moments(cells.cell_count());
  for_cells(moments.size(), make, threads, [&](PieceIntegrator& integrator, std::size_t i) {
    const std::uint64_t first = cells.cell_offset[i], end = cells.cell_offset[i + 1];
    if (first < end) moments[i].origin = Piece(cells, box, first).vertex(0);
    for (std::uint64_t p = first; p < end; ++p) integrator.add(Piece(cells, box, p), moments[i]);
  });
  return moments;
}

Adjacency wall_integrals(const Cells& cells, const DomainBox& box, std::span<const SeedStatus> status,
                         const MakeIntegrator& make, int threads) {
  const Rows rows(cells, status);
  std::vector<double> value(rows.neighbor().size(), 0.0);
  for_cells(cells.cell_count(), make, threads, [&](PieceIntegrator& integrator, std::size_t i) {
    for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
      const Piece piece(cells, box, p);
      for (std::uint64_t f = piece.first_face(); f < piece.end_face(); ++f) {
        const Border& border = piece.border(f);
        if (border.kind != Border::Kind::wall) continue;
        const std::uint64_t at = rows.find(i, border.index);
        if (at == Rows::none) continue;
        if (border.index > i || rows.find(border.index, static_cast<std::uint32_t>(i)) == Rows::none)
          value[at] += integrator.over_face(piece, f);
      }
    }
  });
  return both_sides(rows, value);
}

}  // namespace powercell
