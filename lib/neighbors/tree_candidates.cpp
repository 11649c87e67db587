#include "lib/neighbors/tree_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lib/cl/quirks.hpp"

namespace powercell {
namespace {

/// The rows (q, dw, error) that the kernel reads, for the plane 2 q.y = |q|^2 + dw. |q| is about the distance
/// of the plane, so that nothing cancels.
std::vector<double> plane_rows(const CellPlanes& planes, double scale) {
  std::vector<double> rows;
  for (const LocalPlane& plane : planes.plane) {
    const double offset = scale * plane.offset, length = std::max(std::abs(offset), 0x1p-20);
    double q2 = 0;
    for (const double n : plane.normal) {
      rows.push_back(n * length);
      q2 += rows.back() * rows.back();
    }
    rows.push_back(2 * offset * length - q2);
    rows.push_back(scale * plane.error);
  }
  return rows;
}

/// The first plane of each rank, then the number of planes.
std::vector<std::uint32_t> plane_offsets(const CellPlanes& planes, std::size_t seeds) {
  std::vector<std::uint32_t> offset;
  for (std::size_t at = 0; at < planes.rank.size(); ++at)
    offset.resize(planes.rank[at] + std::size_t{1},
                  static_cast<std::uint32_t>(at == 0 ? 0 : planes.end[at - 1]));
  offset.resize(seeds + 1, static_cast<std::uint32_t>(planes.plane.size()));
  return offset;
}

}  // namespace

Variant without_cells(const Scene& scene) {
  return {scene.mesh().dimension,
          scene.mesh().cell_dimension,
          scene.float32(),
          {1, 1},
          cl::lane_width(scene.context()->settings(), scene.mesh().cell_dimension)};
}

TreeBlocks::Tree device_tree(const Scene& scene) {
  return {scene.buffers.points.handle(),
          scene.buffers.node_low.handle(),
          scene.buffers.node_high.handle(),
          scene.buffers.level_offset.handle(),
          static_cast<std::uint32_t>(scene.seeds.size()),
          scene.tree.level_offset.back(),
          static_cast<int>(scene.tree.levels())};
}

TreeCandidates::TreeCandidates(const Scene& scene, bool searched)
    : scene_(scene), blocks_(scene.context(), without_cells(scene), scene.buffers.blocks) {
  BlockBuffers& buffers = *scene.buffers.blocks;
  if (!searched) {
    blocks_.allocate();
  } else if (!buffers.current) {
    blocks_.enqueue(device_tree(scene));
    buffers.current = true;
  }
}

void TreeCandidates::append_arguments(cl::Kernel& kernel) const {
  blocks_.append_arguments(kernel, device_tree(scene_));
}

std::unique_ptr<Candidates> TreeCandidates::for_scene(const Scene& scene) const {
  return std::make_unique<TreeCandidates>(scene);
}

std::unique_ptr<Candidates> TreeCandidates::on(const Scene& scene) const {
  return std::make_unique<TreeCandidates>(scene);
}

RegionCandidates::RegionCandidates(const Scene& scene, std::span<const std::uint64_t> list_offset,
                                   std::span<const std::uint32_t> list_seed, bool all_listed)
    : TreeCandidates(scene, !all_listed),
      all_listed_(all_listed),
      list_offset_(scene.context()),
      list_seed_(scene.context()) {
  std::vector<std::uint64_t> offset(list_offset.begin(), list_offset.end());
  offset.resize(scene.mesh().region_count() + 1, offset.back());
  list_offset_.upload(offset);
  list_seed_.upload(list_seed);
}

void RegionCandidates::append_arguments(cl::Kernel& kernel) const {
  kernel.more_args(list_offset_, list_seed_);
  TreeCandidates::append_arguments(kernel);
}

std::unique_ptr<Candidates> RegionCandidates::for_scene(const Scene& scene) const {
  const auto seeds = static_cast<std::uint32_t>(scene.seeds.size());
  std::vector<std::uint64_t> offset{0};
  std::vector<std::uint32_t> seed(seeds * scene.mesh().region_count());
  for (std::size_t r = 0; r < scene.mesh().region_count(); ++r) {
    const auto first = seed.begin() + static_cast<std::ptrdiff_t>(offset.back());
    std::iota(first, first + seeds, 0U);
    offset.push_back(offset.back() + seeds);
  }
  return std::make_unique<RegionCandidates>(scene, offset, seed, false);
}

std::unique_ptr<Candidates> RegionCandidates::on(const Scene& scene) const {
  return std::make_unique<RegionCandidates>(scene, list_offset_.download(), list_seed_.download(),
                                            all_listed_);
}

CellCandidates::CellCandidates(TreeCandidates tree, const CellWalls& walls, const CellPlanes& planes)
    : TreeCandidates(std::move(tree)),
      wall_offset_(scene().context()),
      neighbor_(scene().context()),
      plane_offset_(scene().context()),
      plane_(scene().context()) {
  wall_offset_.upload(walls.offset);
  neighbor_.upload(walls.neighbor);
  plane_offset_.upload(plane_offsets(planes, scene().seeds.size()));
  const std::vector<double> rows = plane_rows(planes, scene().frame().scale);
  plane_.reserve(rows.size() * sizeof(double));
  if (!rows.empty()) plane_.write(rows.data(), rows.size() * sizeof(double));
}

CellCandidates::CellCandidates(TreeCandidates tree, const CellCandidates& other)
    : TreeCandidates(std::move(tree)),
      wall_offset_(scene().context()),
      neighbor_(scene().context()),
      plane_offset_(scene().context()),
      plane_(scene().context()) {
  wall_offset_.upload(other.wall_offset_.download());
  neighbor_.upload(other.neighbor_.download());
  plane_offset_.upload(other.plane_offset_.download());
  std::vector<std::byte> rows(other.plane_.bytes());
  plane_.reserve(rows.size());
  other.plane_.read(rows.data(), rows.size());
  plane_.write(rows.data(), rows.size());
}

void CellCandidates::append_arguments(cl::Kernel& kernel) const {
  TreeCandidates::append_arguments(kernel);
  kernel.more_args(wall_offset_, neighbor_, plane_offset_, plane_);
}

std::unique_ptr<Candidates> CellCandidates::for_scene(const Scene& scene) const {
  CellWalls walls;
  walls.dimension = scene.mesh().dimension;
  const auto seeds = static_cast<std::uint32_t>(scene.seeds.size());
  for (std::uint32_t rank = 0; rank < seeds; ++rank) {
    walls.offset.push_back(static_cast<std::uint32_t>(walls.neighbor.size()));
    for (std::uint32_t other = 0; other < seeds; ++other)
      if (other != rank) walls.neighbor.push_back(other);
  }
  walls.offset.push_back(static_cast<std::uint32_t>(walls.neighbor.size()));
  return std::make_unique<CellCandidates>(TreeCandidates(scene), walls, CellPlanes{});
}

std::unique_ptr<Candidates> CellCandidates::on(const Scene& scene) const {
  return std::unique_ptr<Candidates>(new CellCandidates(TreeCandidates(scene), *this));
}

}  // namespace powercell
