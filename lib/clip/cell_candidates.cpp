#include "lib/clip/cell_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "kernels/layout.h"
#include "lib/clip/clipper.hpp"
#include "lib/report/log.hpp"

namespace powercell {
namespace {

constexpr std::size_t chunk_cells = std::size_t{1} << 15;
/// Where device memory does not suffice, chunks are halved down to this before the error is passed on.
constexpr std::size_t least_chunk_cells = 1024;
/// Cells are proved with vertices this near to the true ones.
constexpr double vertex_error_double = 1.0 / (1 << MARGIN_BITS_DOUBLE),
                 vertex_error_float = 1.0 / (1 << MARGIN_BITS_FLOAT);

/// The search in the tree of another source.
class TreeOf : public Candidates {
 public:
  explicit TreeOf(TreeCandidates& tree) : tree_(tree) {}
  std::string_view file() const override { return "clip/by_tree.cl"; }
  std::string_view kernel() const override { return "clip_by_tree_kernel"; }
  std::size_t most_pairs(int round) const override { return tree_.most_pairs(round); }
  void prepare(std::span<const std::uint32_t>, int) override {}
  void set_arguments(cl::Kernel& kernel, unsigned first) override {
    tree_.TreeCandidates::set_arguments(kernel, first);
  }
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override {
    return std::make_unique<TreeCandidates>(scene);
  }

 private:
  TreeCandidates& tree_;
};

/// Whole cells as they come from the device.
class WallCollection {
 public:
  explicit WallCollection(const Scene& scene) : unit_(scene.frame().unit(1)) {
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
      throw Error(ErrorCode::unsupported, "the cells have more than 2^32 walls");
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

CellWalls clip_cells(const Scene& scene, TreeCandidates& candidates, std::span<const std::uint32_t> ranks) {
  TreeOf tree(candidates);
  std::optional<Clipper> clipper;
  const auto around = static_cast<std::uint32_t>(scene.mesh().region_count() - 1);
  std::size_t chunk = std::min(chunk_cells, ranks.size());
  const std::vector<std::uint32_t> regions(chunk, around);
  WallCollection cells(scene);
  for (std::size_t begin = 0; begin < ranks.size();) {
    const std::size_t count = std::min(chunk, ranks.size() - begin);
    const PieceSet* pieces = nullptr;
    try {
      if (!clipper) clipper.emplace(scene, tree, OUTPUT_MOMENTS | OUTPUT_WALLS | OUTPUT_GEOMETRY);
      pieces = &clipper->clip(ranks.subspan(begin, count), std::span(regions).first(count));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::out_of_device_memory || chunk <= least_chunk_cells) throw;
      chunk = std::max(least_chunk_cells, chunk / 2);
      write_log(LogLevel::info, [&] {
        return "device memory does not suffice; chunks of " + std::to_string(chunk) + " cells from now on";
      });
      clipper.reset();  // gives its buffers back
      continue;
    }
    for (std::size_t k = 0; k < count; ++k) cells.add(ranks[begin + k], *pieces, k);
    begin += count;
  }
  cells.fill_up_to(scene.seeds().size());
  return std::move(cells.walls);
}

}  // namespace

CellCandidates::CellCandidates(const Scene& scene, std::span<const std::uint32_t> ranks)
    : TreeCandidates(scene),
      scene_(scene),
      walls_(clip_cells(scene, *this, ranks)),
      wall_offset_(scene.context()),
      neighbor_(scene.context()),
      plane_offset_(scene.context()),
      plane_(scene.context()) {
  wall_offset_.upload(walls_.offset);
  neighbor_.upload(walls_.neighbor);
  set_planes({}, {});
}

void CellCandidates::set_planes(const CellPlanes& planes, Regions regions) {
  cut_by_planes_ = planes.rank;
  regions_ = std::move(regions);
  std::vector<std::uint32_t> offset;
  for (std::size_t at = 0; at < planes.rank.size(); ++at)
    offset.resize(planes.rank[at] + std::size_t{1},
                  static_cast<std::uint32_t>(at == 0 ? 0 : planes.end[at - 1]));
  offset.resize(scene_.seeds().size() + 1, static_cast<std::uint32_t>(planes.plane.size()));
  plane_offset_.upload(offset);
  // 2 q.y = |q|^2 + dw, with q about as long as the plane is far, so that nothing cancels.
  const double scale = scene_.frame().scale;
  std::vector<double> rows;
  for (const LocalPlane& plane : planes.plane) {
    const double height = scale * plane.height, length = std::max(std::abs(height), 0x1p-20);
    double q2 = 0;
    for (const double n : plane.normal) {
      rows.push_back(n * length);
      q2 += rows.back() * rows.back();
    }
    rows.push_back(2 * height * length - q2);
    rows.push_back(scale * plane.error);
  }
  plane_.reserve(rows.size() * sizeof(double));
  if (!rows.empty()) plane_.write(rows.data(), rows.size() * sizeof(double));
}

std::vector<std::uint32_t> CellCandidates::regions_for_host(std::uint32_t rank, std::uint32_t region) const {
  if (region + 1 < scene_.mesh().region_count() ||
      !std::binary_search(cut_by_planes_.begin(), cut_by_planes_.end(), rank))
    return {region};
  return regions_(rank);
}

void CellCandidates::set_arguments(cl::Kernel& kernel, unsigned first) {
  TreeCandidates::set_arguments(kernel, first);
  kernel.args_from(first + TreeBlocks::argument_count, wall_offset_, neighbor_, plane_offset_, plane_);
}

std::unique_ptr<Candidates> CellCandidates::for_scene(const Scene& scene) const {
  std::vector<std::uint32_t> ranks(scene.seeds().size());
  std::iota(ranks.begin(), ranks.end(), 0U);
  return std::make_unique<CellCandidates>(scene, ranks);
}

}  // namespace powercell
