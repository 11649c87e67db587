#include "lib/neighbors/tree_candidates.hpp"

#include "lib/scene/variant.hpp"

namespace powercell {

Variant without_cells(const Scene& scene) {
  return {scene.mesh().dimension, scene.mesh().cell_dimension, scene.float32(), {1, 1}, 0};
}

TreeCandidates::TreeCandidates(const Scene& scene, bool searched)
    : scene_(scene), blocks_(scene.context(), without_cells(scene)) {
  if (searched)
    blocks_.enqueue(device_tree(scene));
  else
    blocks_.leave_empty();
}

TreeBlocks::Tree device_tree(const Scene& scene) {
  return {scene.points.handle(),
          scene.node_low.handle(),
          scene.node_high.handle(),
          scene.level_offset.handle(),
          static_cast<std::uint32_t>(scene.seeds().size()),
          scene.tree().level_offset.back(),
          static_cast<int>(scene.tree().levels())};
}

}  // namespace powercell
