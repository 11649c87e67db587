#include "lib/collect/join_solid.hpp"

#include <algorithm>

#include "lib/collect/dual.hpp"
#include "lib/collect/join_faces.hpp"

namespace powercell {
namespace {

class Joining {
 public:
  Joining(const JoinedCells& whole, const SeedSet& seeds, const Frame& frame)
      : whole_(whole), seeds_(seeds), frame_(frame) {
    out_.dimension = out_.cell_dimension = 3;
    out_.vertex_offset = out_.face_offset = out_.loop_offset = {0};
  }

  void add_whole(std::size_t cell) {
    const auto copy = [](auto& to, const auto& from, std::uint64_t begin, std::uint64_t end) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
                from.begin() + static_cast<std::ptrdiff_t>(end));
    };
    copy(out_.vertices, whole_.vertices, 3 * whole_.vertex_offset[cell], 3 * whole_.vertex_offset[cell + 1]);
    const std::uint64_t first = whole_.face_offset[cell], last = whole_.face_offset[cell + 1];
    copy(out_.face_border, whole_.face_border, first, last);
    const std::uint64_t shift = out_.loop.size() - whole_.loop_offset[first];
    copy(out_.loop, whole_.loop, whole_.loop_offset[first], whole_.loop_offset[last]);
    for (std::uint64_t f = first; f < last; ++f)
      out_.loop_offset.push_back(whole_.loop_offset[f + 1] + shift);
    end_cell();
  }

  void add(const CellAtBoundary& cell) {
    const solid::CellFaces& faces = *cell.faces;
    for (std::size_t k = 0; k < faces.vertices.size(); ++k)
      out_.vertices.push_back(seeds_.positions[3 * std::size_t{cell.rank} + k % 3] +
                              faces.vertices[k] / frame_.scale);
    const std::size_t base = out_.loop.size();
    out_.loop.insert(out_.loop.end(), faces.loop.begin(), faces.loop.end());
    for (const std::size_t end : faces.end) out_.loop_offset.push_back(base + end);
    for (const std::int32_t border : faces.border)
      out_.face_border.push_back(
          border >= 0 ? Border{Border::Kind::wall, seeds_.input[static_cast<std::size_t>(border)]}
                      : Border{Border::Kind::boundary, static_cast<std::uint32_t>(~border)});
    end_cell();
  }

  JoinedCells finish() { return std::move(out_); }

 private:
  void end_cell() {
    out_.vertex_offset.push_back(out_.vertices.size() / 3);
    out_.face_offset.push_back(out_.loop_offset.size() - 1);
  }

  const JoinedCells& whole_;
  const SeedSet& seeds_;
  const Frame& frame_;
  JoinedCells out_;
};

/// Positions in the caller's order, of seeds that have cells.
std::vector<double> positions_of(const SeedSet& seeds) {
  std::vector<double> positions(3 * seeds.input_count);
  for (std::size_t rank = 0; rank < seeds.size(); ++rank)
    std::copy_n(&seeds.positions[3 * rank], 3, &positions[3 * std::size_t{seeds.input[rank]}]);
  return positions;
}

std::vector<std::uint32_t> simplices_of(const SolidGeometryInput& input) {
  std::vector<std::uint32_t> rows = corners_of_cells(input.whole);
  const std::vector<std::uint32_t>& seed = input.seeds.input;
  for (const CellAtBoundary& cell : input.at_boundary)
    for (const auto& [a, b, c] : cell.faces->corners)
      rows.insert(rows.end(), {seed[cell.rank], seed[a], seed[b], seed[c]});
  std::size_t kept = 0;
  for (std::size_t row = 0; row < rows.size(); row += 4) {
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(row);
    const bool all_have_cells =
        std::all_of(first, first + 4, [&](std::uint32_t i) { return input.status[i] == SeedStatus::ok; });
    if (!all_have_cells) continue;
    std::copy(first, first + 4, rows.begin() + static_cast<std::ptrdiff_t>(kept));
    kept += 4;
  }
  rows.resize(kept);
  return rows;
}

}  // namespace

SolidGeometry join_solid(const SolidGeometryInput& input) {
  const std::size_t n = input.status.size();
  std::vector<const CellAtBoundary*> by_seed(n);
  for (const CellAtBoundary& cell : input.at_boundary) by_seed[input.seeds.input[cell.rank]] = &cell;
  const JoinedCells whole = join_pieces(input.domain, input.whole);
  Joining joining(whole, input.seeds, input.frame);
  const solid::CellFaces no_faces;
  for (std::size_t i = 0; i < n; ++i) {
    if (input.status[i] != SeedStatus::ok)
      joining.add({0, &no_faces});
    else if (by_seed[i])
      joining.add(*by_seed[i]);
    else
      joining.add_whole(i);
  }
  SolidGeometry geometry{joining.finish(), simplices_of(input)};
  if (!input.coincident.empty())
    geometry.joined = without_coincident_walls(geometry.joined, input.coincident, positions_of(input.seeds));
  return geometry;
}

}  // namespace powercell
