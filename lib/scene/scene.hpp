/// \file
/// Everything that a clip kernel reads: the domain, and the seeds with their packed tree.
#pragma once

#include <memory>

#include "lib/scene/domain_buffers.hpp"
#include "lib/seeds/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// What clip kernels search, made on the device from seeds and tree (lib/neighbors/tree_blocks.hpp).
struct BlockBuffers {
  explicit BlockBuffers(const std::shared_ptr<cl::Context>& context)
      : seed_block(context),
        node_block(context),
        near_bound(context),
        near_leaves(context),
        near_count(context) {}

  cl::RawBuffer seed_block, node_block, near_bound;
  cl::Buffer<std::uint32_t> near_leaves, near_count;
  bool current = false;  ///< made of the seeds and the tree as they are
};

/// Seeds and packed tree in device memory. Later uploads reuse the buffers.
class SeedBuffers {
 public:
  explicit SeedBuffers(const std::shared_ptr<cl::Context>& context)
      : points(context),
        node_low(context),
        node_high(context),
        level_offset(context),
        blocks(std::make_shared<BlockBuffers>(context)) {}

  void upload(const Frame& frame, const SeedSet& seeds, const PackedTree& tree, int threads);
  /// Uploads what depends on the weights only.
  void upload_weights(const Frame& frame, const SeedSet& seeds, const PackedTree& tree, int threads);

  cl::RawBuffer points, node_low, node_high;  ///< seed_t
  cl::Buffer<std::uint32_t> level_offset;
  std::shared_ptr<BlockBuffers> blocks;
  std::uint64_t uploads = 0;  ///< how often the content was replaced
};

/// A view of domain and seeds on host and device; must not outlive them.
struct Scene {
  const DomainBuffers& domain;
  const SeedBuffers& buffers;
  const SeedSet& seeds;
  const PackedTree& tree;
  /// Break ties by the order of the coordinates instead of the ranks, which translations keep.
  bool ties_by_position = false;

  const std::shared_ptr<cl::Context>& context() const { return domain.context(); }
  const RegionMesh& mesh() const { return domain.mesh(); }
  const Frame& frame() const { return domain.frame(); }
  bool float32() const { return domain.float32(); }
};

/// A scene that owns its buffers, for one-off work. Refers to mesh, seeds and tree.
struct OwnScene {
  DomainBuffers domain;
  SeedBuffers buffers;
  Scene scene;

  OwnScene(const std::shared_ptr<cl::Context>& context, const RegionMesh& mesh, bool float32,
           const SeedSet& seeds, const PackedTree& tree);
  OwnScene(const OwnScene&) = delete;
  OwnScene& operator=(const OwnScene&) = delete;
};

}  // namespace powercell
