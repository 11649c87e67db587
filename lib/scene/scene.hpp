/// \file
/// Everything a clip kernel reads, in device memory and, for the last resort, on the host.
#pragma once

#include <memory>

#include "kernels/layout.h"
#include "lib/cl/buffer.hpp"
#include "lib/domain/frame.hpp"
#include "lib/seeds/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The graph that all volume regions of one shape start from.
region_shape_t region_shape(RegionShape shape);

/// What the kernels know of the regions behind the facets of `mesh` (BEHIND_NOTHING in kernels/layout.h).
std::vector<std::int32_t> regions_behind(const RegionMesh& mesh);

/// Domain, seeds and tree on the device. Buffers are kept between uploads.
class Scene {
 public:
  Scene(const std::shared_ptr<cl::Context>& context, const RegionMesh& mesh, bool float32);

  /// Uploads positions, weights and tree; keeps references to both until the next call.
  void set_seeds(const SeedSet& seeds, const PackedTree& tree, int threads = 1);
  /// The same after a change of the weights alone: the far corners of the boxes stay.
  void set_weights(const SeedSet& seeds, const PackedTree& tree, int threads = 1);

  const std::shared_ptr<cl::Context>& context() const { return context_; }
  const RegionMesh& mesh() const { return mesh_; }
  const SeedSet& seeds() const { return *seeds_; }
  const PackedTree& tree() const { return *tree_; }
  const Frame& frame() const { return frame_; }
  bool float32() const { return frame_.split; }

  cl::RawBuffer corners, points, node_low, node_high;  // seed_t
  cl::Buffer<std::uint32_t> region_offset, region_vertex, level_offset;
  cl::Buffer<std::int32_t> behind;  // per facet: BEHIND_NOTHING or a corner (kernels/layout.h)
  cl::Buffer<region_shape_t> shape;

 private:
  void upload(cl::RawBuffer& buffer, int dimension, std::span<const double> positions,
              std::span<const double> weights, int threads) const;

  std::shared_ptr<cl::Context> context_;
  const RegionMesh& mesh_;
  Frame frame_;
  const SeedSet* seeds_ = nullptr;
  const PackedTree* tree_ = nullptr;
};

}  // namespace powercell
