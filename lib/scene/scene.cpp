#include "lib/scene/scene.hpp"

namespace powercell {
namespace {

void upload_points(cl::RawBuffer& buffer, const Frame& frame, int dimension,
                   std::span<const double> positions, std::span<const double> weights, int threads) {
  const std::size_t bytes =
      dimension == 0 ? 0 : positions.size() / static_cast<std::size_t>(dimension) * Frame::point_bytes;
  buffer.reserve(bytes);
  buffer.fill(bytes, [&](std::byte* to) { frame.pack_to(to, dimension, positions, weights, threads); });
}

}  // namespace

void SeedBuffers::upload(const Frame& frame, const SeedSet& seeds, const PackedTree& tree, int threads) {
  upload_weights(frame, seeds, tree, threads);
  upload_points(node_high, frame, tree.dimension, tree.high, {}, threads);
  level_offset.upload(tree.level_offset);
}

void SeedBuffers::upload_weights(const Frame& frame, const SeedSet& seeds, const PackedTree& tree,
                                 int threads) {
  blocks->current = false;
  ++uploads;
  upload_points(points, frame, seeds.dimension, seeds.positions, seeds.weights, threads);
  upload_points(node_low, frame, tree.dimension, tree.low, tree.weight, threads);
}

OwnScene::OwnScene(const std::shared_ptr<cl::Context>& context, const RegionMesh& mesh, bool float32,
                   const SeedSet& seeds, const PackedTree& tree)
    : domain(context, mesh, float32), buffers(context), scene{domain, buffers, seeds, tree} {
  buffers.upload(domain.frame(), seeds, tree, 1);
}

}  // namespace powercell
