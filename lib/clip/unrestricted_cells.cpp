#include "lib/clip/unrestricted_cells.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "kernels/layout.h"
#include "lib/base/progress.hpp"
#include "lib/clip/clipper.hpp"
#include "lib/clip/in_chunks.hpp"

namespace powercell {
namespace {

constexpr std::size_t chunk_cells = std::size_t{1} << 15, least_chunk_cells = 1024;
/// Bounds for the error of the vertices of a proved cell, relative to its radius (docs/mathematics.md (82)).
constexpr double vertex_error_double = 1.0 / (1 << MARGIN_BITS_DOUBLE),
                 vertex_error_float = 1.0 / (1 << MARGIN_BITS_FLOAT);

class CellWallsBuilder {
 public:
  explicit CellWallsBuilder(const Scene& scene) : unit_(scene.frame().unit(1)) {
    walls.dimension = scene.mesh().dimension;
    walls.vertex_error = scene.float32() ? vertex_error_float : vertex_error_double;
  }

  void add(std::uint32_t rank, const PieceSet& pieces, std::size_t pair) {
    fill_up_to(rank);
    if (pieces.status[pair] == PIECE_EMPTY) {
      walls.neighbor.push_back(rank);
      return;
    }
    const PieceBatch& batch = pieces.batches[pieces.batch[pair]];
    const std::uint32_t row = pieces.row[pair];
    for (std::uint32_t f = batch.face_offset[row]; f < batch.face_offset[row + 1]; ++f)
      if (batch.border[f] >= 0) walls.neighbor.push_back(static_cast<std::uint32_t>(batch.border[f]));
    if (walls.neighbor.size() > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorCode::unsupported, "the cells at the boundary have more than 2^32 walls");
    const auto d = static_cast<std::size_t>(walls.dimension);
    const std::size_t first = batch.vertex_offset[row] * d, count = batch.vertices(row) * d,
                      to = walls.vertex.size();
    walls.vertex.resize(to + count);
    for (std::size_t k = 0; k < count; ++k) walls.vertex[to + k] = batch.vertex[first + k] * unit_;
  }

  void fill_up_to(std::size_t rank) {
    walls.offset.resize(rank + 1, static_cast<std::uint32_t>(walls.neighbor.size()));
    walls.vertex_offset.resize(rank + 1, walls.vertex.size() / static_cast<std::size_t>(walls.dimension));
  }

  CellWalls walls;

 private:
  double unit_;
};

}  // namespace

CellWalls clip_unrestricted_cells(const Scene& scene, Candidates& candidates,
                                  std::span<const std::uint32_t> ranks,
                                  const std::function<bool(double)>& progress) {
  std::optional<Clipper> clipper;
  const auto container = static_cast<std::uint32_t>(scene.mesh().region_count() - 1);
  const std::size_t chunk = std::min(chunk_cells, ranks.size());
  const std::vector<std::uint32_t> regions(chunk, container);
  CellWallsBuilder cells(scene);
  in_chunks(
      ranks.size(), {chunk, least_chunk_cells, "cells"},
      [&](std::size_t begin, std::size_t end) {
        if (!clipper)
          clipper.emplace(scene, candidates, OUTPUT_MOMENTS | OUTPUT_WALLS | OUTPUT_GEOMETRY,
                          ClipOptions{.pairs = ranks.size()});
        const PieceSet& pieces =
            clipper->clip(ranks.subspan(begin, end - begin), std::span(regions).first(end - begin));
        for (std::size_t k = 0; begin + k < end; ++k) cells.add(ranks[begin + k], pieces, k);
        report_progress(progress, static_cast<double>(end), static_cast<double>(ranks.size()));
      },
      [&] { clipper.reset(); });
  cells.fill_up_to(scene.seeds.size());
  return std::move(cells.walls);
}

}  // namespace powercell
