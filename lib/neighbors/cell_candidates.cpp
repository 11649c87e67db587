#include "lib/neighbors/cell_candidates.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "kernels/layout.h"
#include "lib/clip/clipper.hpp"
#include "lib/domain/region_mesh.hpp"

namespace powercell {
namespace {

constexpr std::size_t chunk_cells = std::size_t{1} << 15;
/// The box is larger than the domain, so that no cell of it is cut to a sliver where it just meets the
/// domain.
constexpr double margin = 1.0 / 16;

Domain box_around(const RegionMesh& mesh) {
  std::vector<double> low, high;
  double size = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k)
    size = std::max(size, mesh.high[k] - mesh.low[k]);
  for (std::size_t k = 0; k < static_cast<std::size_t>(mesh.dimension); ++k) {
    low.push_back(mesh.low[k] - margin * size);
    high.push_back(mesh.high[k] + margin * size);
  }
  return Domain::box(low, high);
}

/// Neighbours by rank.
struct Walls {
  std::vector<std::uint32_t> offset, neighbor;

  void add(std::uint32_t rank, const PieceSet& pieces, std::size_t pair) {
    while (offset.size() <= rank) offset.push_back(static_cast<std::uint32_t>(neighbor.size()));
    if (pieces.status[pair] == PIECE_EMPTY) {
      neighbor.push_back(rank);  // its own neighbour: no cell
      return;
    }
    const PieceBatch& batch = pieces.batches[pieces.batch[pair]];
    const std::uint32_t row = pieces.row[pair];
    for (std::uint32_t f = batch.face_offset[row]; f < batch.face_offset[row + 1]; ++f)
      if (batch.border[f] >= 0) neighbor.push_back(static_cast<std::uint32_t>(batch.border[f]));
    if (neighbor.size() > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorCode::unsupported, "the cells have more than 2^32 walls");
  }
};

Walls clip_cells(const Scene& scene, std::span<const std::uint32_t> ranks) {
  const Domain box = box_around(scene.mesh());
  Scene around(scene.context(), box.mesh(), scene.float32());
  around.set_seeds(scene.seeds(), scene.tree());
  TreeCandidates tree(around);
  Clipper clipper(around, tree, OUTPUT_MOMENTS | OUTPUT_WALLS);
  const std::vector<std::uint32_t> regions(std::min(chunk_cells, ranks.size()), 0);
  Walls walls;
  for (std::size_t begin = 0; begin < ranks.size(); begin += chunk_cells) {
    const std::size_t count = std::min(chunk_cells, ranks.size() - begin);
    const PieceSet& pieces = clipper.clip(ranks.subspan(begin, count), std::span(regions).first(count));
    for (std::size_t k = 0; k < count; ++k) walls.add(ranks[begin + k], pieces, k);
  }
  walls.offset.resize(scene.seeds().size() + 1, static_cast<std::uint32_t>(walls.neighbor.size()));
  return walls;
}

}  // namespace

CellCandidates::CellCandidates(const Scene& scene, std::span<const std::uint32_t> ranks)
    : TreeCandidates(scene), wall_offset_(scene.context()), neighbor_(scene.context()) {
  const Walls walls = clip_cells(scene, ranks);
  wall_offset_.upload(walls.offset);
  neighbor_.upload(walls.neighbor);
}

void CellCandidates::set_arguments(cl::Kernel& kernel, unsigned first) {
  TreeCandidates::set_arguments(kernel, first);
  kernel.args_from(first + TreeBlocks::argument_count, wall_offset_, neighbor_);
}

std::unique_ptr<Candidates> CellCandidates::for_scene(const Scene& scene) const {
  std::vector<std::uint32_t> ranks(scene.seeds().size());
  std::iota(ranks.begin(), ranks.end(), 0U);
  return std::make_unique<CellCandidates>(scene, ranks);
}

}  // namespace powercell
