#include "lib/neighbors/tree_blocks.hpp"

#include <utility>

#include "kernels/layout.h"
#include "lib/scene/scene.hpp"
#include "lib/scene/variant.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell {
namespace {

constexpr const char* file = "neighbors/build_blocks.cl";

/// \pre seeds > 0
std::uint32_t leaf_count(std::uint32_t seeds) {
  return (seeds - 1) / PackedTree::fan + 1;
}

}  // namespace

TreeBlocks::TreeBlocks(const std::shared_ptr<cl::Context>& context, const Variant& variant,
                       std::shared_ptr<BlockBuffers> buffers)
    : pack_(context, context->program(file, variant.defines()), "pack_blocks"),
      list_(context, context->program(file, variant.defines()), "list_near"),
      row_bytes_(PackedTree::fan * (variant.float32 ? 2 * sizeof(float) : sizeof(double))),
      bound_bytes_(variant.float32 ? sizeof(float) : sizeof(double)),
      dimension_(static_cast<std::size_t>(variant.dimension)),
      buffers_(std::move(buffers)) {}

void TreeBlocks::pack(const Tree& tree) {
  const std::uint32_t leaves = leaf_count(tree.seed_count), above = tree.node_count - leaves;
  buffers_->seed_block.reserve(std::size_t{leaves} * (dimension_ + 1) * row_bytes_);
  buffers_->node_block.reserve(std::size_t{above} * (2 * dimension_ + 1) * row_bytes_);
  pack_
      .args(leaves, above, tree.seeds, tree.seed_count, tree.node_low, tree.node_high, tree.level_offset,
            cl_int{tree.levels}, buffers_->seed_block, buffers_->node_block)
      .submit(leaves);
}

void TreeBlocks::list(const Tree& tree, std::uint32_t cells) {
  const std::uint32_t leaves = leaf_count(cells);
  buffers_->near_bound.reserve(std::size_t{leaves} * bound_bytes_);
  buffers_->near_leaves.resize(std::size_t{leaves} * NEAR_MOST);
  buffers_->near_count.resize(leaves);
  list_
      .args(leaves, tree.seeds, tree.seed_count, tree.node_low, tree.node_high, tree.level_offset,
            cl_int{tree.levels}, buffers_->seed_block, buffers_->node_block, buffers_->near_leaves,
            buffers_->near_count, buffers_->near_bound)
      .submit(leaves);
}

void TreeBlocks::allocate() {
  for (cl::RawBuffer* buffer : {&buffers_->seed_block, &buffers_->node_block, &buffers_->near_bound})
    buffer->reserve(0);
  buffers_->near_leaves.resize(0);
  buffers_->near_count.resize(0);
}

void TreeBlocks::append_pack_arguments(cl::Kernel& kernel, const Tree& tree) const {
  kernel.more_args(tree.seeds, tree.seed_count, tree.node_low, tree.node_high, tree.level_offset,
                   cl_int{tree.levels}, buffers_->seed_block, buffers_->node_block);
}

void TreeBlocks::append_arguments(cl::Kernel& kernel, const Tree& tree) const {
  append_pack_arguments(kernel, tree);
  kernel.more_args(buffers_->near_leaves, buffers_->near_count, buffers_->near_bound);
}

}  // namespace powercell
