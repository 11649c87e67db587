#include "lib/neighbors/tree_candidates.hpp"

#include <numeric>

#include "lib/cl/quirks.hpp"

namespace powercell {
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

CellCandidates::CellCandidates(TreeCandidates tree, std::span<const std::uint32_t> wall_offset,
                               std::span<const std::uint32_t> neighbor)
    : TreeCandidates(std::move(tree)), wall_offset_(scene().context()), neighbor_(scene().context()) {
  wall_offset_.upload(wall_offset);
  neighbor_.upload(neighbor);
}

void CellCandidates::append_arguments(cl::Kernel& kernel) const {
  TreeCandidates::append_arguments(kernel);
  kernel.more_args(wall_offset_, neighbor_);
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
  return std::make_unique<CellCandidates>(TreeCandidates(scene), walls.offset, walls.neighbor);
}

std::unique_ptr<Candidates> CellCandidates::on(const Scene& scene) const {
  return std::make_unique<CellCandidates>(TreeCandidates(scene), wall_offset_.download(),
                                          neighbor_.download());
}

}  // namespace powercell
