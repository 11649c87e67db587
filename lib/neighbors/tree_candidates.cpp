#include "lib/neighbors/tree_candidates.hpp"

#include "lib/clip/variant.hpp"

namespace powercell {
namespace {

Variant without_cells(const Scene& scene) {
  return {scene.mesh().dimension, scene.mesh().cell_dimension, scene.float32(), {1, 1}, 0};
}

}  // namespace

TreeCandidates::TreeCandidates(const Scene& scene)
    : scene_(scene), blocks_(scene.context(), without_cells(scene)) {
  blocks_.enqueue(device_tree());
}

TreeBlocks::Tree TreeCandidates::device_tree() const {
  return {scene_.points.handle(),
          scene_.node_low.handle(),
          scene_.node_high.handle(),
          scene_.level_offset.handle(),
          static_cast<std::uint32_t>(scene_.seeds().size()),
          scene_.tree().level_offset.back(),
          static_cast<int>(scene_.tree().levels())};
}

}  // namespace powercell
