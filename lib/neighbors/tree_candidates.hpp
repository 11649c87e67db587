/// \file
/// Candidates from the packed tree, searched in the kernel (kernels/neighbors/tree.cl).
#pragma once

#include <limits>

#include "lib/neighbors/candidates.hpp"
#include "lib/neighbors/tree_blocks.hpp"
#include "lib/scene/scene.hpp"

namespace powercell {

/// The tree of the scene as it is on the device.
TreeBlocks::Tree device_tree(const Scene& scene);
/// The precision and dimensions of the scene, of programs without cells.
Variant without_cells(const Scene& scene);

class TreeCandidates : public Candidates {
 public:
  /// \param searched  whether any pair is to be searched for in the tree
  explicit TreeCandidates(const Scene& scene, bool searched = true);
  std::string_view file() const override { return "clip/by_tree.cl"; }
  std::string_view kernel() const override { return "clip_by_tree_kernel"; }
  std::size_t most_pairs(int) const override { return std::numeric_limits<std::uint32_t>::max(); }
  void prepare(std::span<const std::uint32_t>, int) override {}
  void set_arguments(cl::Kernel& kernel, unsigned first) override {
    blocks_.set_arguments(kernel, first, device_tree(scene_));
  }
  std::unique_ptr<Candidates> for_scene(const Scene& scene) const override {
    return std::make_unique<TreeCandidates>(scene);
  }

 private:
  const Scene& scene_;
  TreeBlocks blocks_;
};

}  // namespace powercell
