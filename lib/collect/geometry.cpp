#include "lib/collect/geometry.hpp"

#include <algorithm>
#include <numeric>

#include "kernels/layout.h"

namespace powercell {

GeometryCollector::GeometryCollector(const RegionMesh& mesh, const SeedSet& seeds, const Frame& frame)
    : mesh_(mesh), seeds_(seeds), frame_(frame) {
  cells_.dimension = mesh.dimension;
  cells_.cell_dimension = mesh.cell_dimension;
  cells_.vertex_offset = {0};
  cells_.face_offset = {0};
  if (mesh.cell_dimension == 3) cells_.loop_offset = {0};
}

Border GeometryCollector::border(std::int32_t code, std::uint32_t region) const {
  if (code >= 0) return {Border::Kind::wall, seeds_.input[static_cast<std::size_t>(code)]};
  return mesh_.facet[mesh_.facet_offset[region] + static_cast<std::uint32_t>(~code)];
}

void GeometryCollector::add_vertices(const PieceBatch& batch, std::size_t row, std::uint32_t rank) {
  const auto d = static_cast<std::size_t>(mesh_.dimension);
  const std::array<double, 3> offset = placement_ ? placement_->offset(rank) : std::array<double, 3>{};
  for (std::size_t v = batch.vertex_offset[row]; v < batch.vertex_offset[row + 1]; ++v)
    for (std::size_t k = 0; k < d; ++k)
      cells_.vertices.push_back(seeds_.positions[rank * d + k] + batch.vertex[v * d + k] / frame_.scale +
                                offset[k]);
}

void GeometryCollector::add_loops(const PieceBatch& batch, std::size_t row) {
  const std::uint32_t* link = batch.link.data() + std::size_t{batch.vertex_offset[row]} * 6;
  const std::uint32_t vertices = batch.vertices(row), faces = batch.faces(row);
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> start(faces, none);
  for (std::uint32_t v = 0; v < vertices; ++v)
    for (int k = 0; k < 3; ++k)
      if (start[link[v * 6 + 3 + k]] == none) start[link[v * 6 + 3 + k]] = v;
  for (std::uint32_t f = 0; f < faces; ++f) {
    std::uint32_t v = start[f];
    do {
      cells_.loop.push_back(v);
      int k = 0;
      while (link[v * 6 + 3 + k] != f) ++k;
      v = link[v * 6 + k];
    } while (v != start[f]);
    cells_.loop_offset.push_back(cells_.loop.size());
  }
}

void GeometryCollector::add(std::span<const std::uint32_t> pair_seed,
                            std::span<const std::uint32_t> pair_region, const PieceSet& pieces) {
  for (std::size_t k = 0; k < pair_seed.size(); ++k) {
    if (pieces.status[k] != PIECE_DONE && pieces.status[k] != PIECE_FLAT) continue;
    const PieceBatch& batch = pieces.batches[pieces.batch[k]];
    const std::size_t row = pieces.row[k];
    piece_rank_.push_back(pair_seed[k]);
    cells_.region.push_back(pair_region[k]);
    add_vertices(batch, row, pair_seed[k]);
    for (std::size_t f = batch.face_offset[row]; f < batch.face_offset[row + 1]; ++f) {
      const std::int32_t code = batch.border[f];
      cells_.border.push_back(border(code, pair_region[k]));
      if (placement_)
        cells_.shift.push_back(
            code >= 0 ? placement_->shift_of_wall(pair_seed[k], static_cast<std::uint32_t>(code)) : Shift{});
    }
    if (mesh_.cell_dimension == 3) add_loops(batch, row);
    cells_.vertex_offset.push_back(cells_.vertices.size() / static_cast<std::size_t>(mesh_.dimension));
    cells_.face_offset.push_back(cells_.border.size());
  }
}

void GeometryCollector::discard(std::span<const std::uint32_t> ranks) {
  for (std::uint32_t& rank : piece_rank_)
    if (std::binary_search(ranks.begin(), ranks.end(), rank)) rank = discarded;
}

namespace {

/// Appends the rows [begin, end) of `values`, of `width` values each.
template <class T>
void append_row(std::vector<T>& to, const std::vector<T>& values, std::uint64_t begin, std::uint64_t end,
                std::size_t width = 1) {
  to.insert(to.end(), values.begin() + static_cast<std::ptrdiff_t>(begin * width),
            values.begin() + static_cast<std::ptrdiff_t>(end * width));
}

}  // namespace

Cells GeometryCollector::finish(const std::vector<SeedStatus>& status, const SeedSet& rows,
                                const std::vector<std::uint32_t>* rank) {
  std::vector<std::uint32_t> input(piece_rank_.size(), discarded);
  for (std::size_t p = 0; p < input.size(); ++p) {
    const std::uint32_t r = piece_rank_[p];
    if (r == discarded) continue;
    input[p] = rows.input[rank ? std::lower_bound(rank->begin(), rank->end(), r) - rank->begin() : r];
  }
  Cells out;
  out.dimension = cells_.dimension;
  out.cell_dimension = cells_.cell_dimension;
  out.cell_offset.assign(rows.input_count + 1, 0);
  const auto is_kept = [&](std::uint32_t i) { return i != discarded && status[i] == SeedStatus::ok; };
  for (const std::uint32_t i : input)
    if (is_kept(i)) ++out.cell_offset[i + std::size_t{1}];
  std::partial_sum(out.cell_offset.begin(), out.cell_offset.end(), out.cell_offset.begin());
  std::vector<std::uint64_t> order(out.cell_offset.back());
  std::vector<std::uint64_t> at(out.cell_offset.begin(), out.cell_offset.end() - 1);
  for (std::uint64_t p = 0; p < input.size(); ++p)
    if (is_kept(input[p])) order[at[input[p]]++] = p;

  const bool loops = cells_.cell_dimension == 3;
  const auto d = static_cast<std::size_t>(cells_.dimension);
  out.region.reserve(cells_.region.size());
  out.vertices.reserve(cells_.vertices.size());
  out.border.reserve(cells_.border.size());
  out.loop.reserve(cells_.loop.size());
  out.vertex_offset = {0};
  out.face_offset = {0};
  if (loops) out.loop_offset = {0};
  for (const std::uint64_t p : order) {
    out.region.push_back(cells_.region[p]);
    append_row(out.vertices, cells_.vertices, cells_.vertex_offset[p], cells_.vertex_offset[p + 1], d);
    append_row(out.border, cells_.border, cells_.face_offset[p], cells_.face_offset[p + 1]);
    if (placement_) append_row(out.shift, cells_.shift, cells_.face_offset[p], cells_.face_offset[p + 1]);
    out.vertex_offset.push_back(out.vertices.size() / d);
    out.face_offset.push_back(out.border.size());
    if (!loops) continue;
    for (std::uint64_t f = cells_.face_offset[p]; f < cells_.face_offset[p + 1]; ++f) {
      append_row(out.loop, cells_.loop, cells_.loop_offset[f], cells_.loop_offset[f + 1]);
      out.loop_offset.push_back(out.loop.size());
    }
  }
  return out;
}

}  // namespace powercell
