#include "lib/neighbors/tree_blocks.hpp"

#include "kernels/layout.h"
#include "lib/scene/variant.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell {
namespace {

constexpr const char* file = "neighbors/build_blocks.cl";

std::uint32_t leaf_count(const TreeBlocks::Tree& tree) {
  return (tree.seed_count - 1) / PackedTree::fan + 1;
}

}  // namespace

TreeBlocks::TreeBlocks(const std::shared_ptr<cl::Context>& context, const Variant& variant)
    : pack_(context, context->program(file, variant.defines()), "pack_blocks"),
      list_(context, context->program(file, variant.defines()), "list_near"),
      row_bytes_(PackedTree::fan * (variant.float32 ? 2 * sizeof(float) : sizeof(double))),
      bound_bytes_(variant.float32 ? sizeof(float) : sizeof(double)),
      dimension_(static_cast<std::size_t>(variant.dimension)),
      seed_block_(context),
      node_block_(context),
      near_bound_(context),
      near_(context),
      near_count_(context) {}

void TreeBlocks::pack(const Tree& tree) {
  const std::uint32_t leaves = leaf_count(tree), above = tree.node_count - leaves;
  seed_block_.reserve(std::size_t{leaves} * (dimension_ + 1) * row_bytes_);
  node_block_.reserve(std::size_t{above} * (2 * dimension_ + 1) * row_bytes_);
  pack_
      .args(leaves, above, tree.seeds, tree.seed_count, tree.node_low, tree.node_high, tree.level_offset,
            cl_int{tree.levels}, seed_block_, node_block_)
      .submit(leaves);
}

void TreeBlocks::list(const Tree& tree) {
  const std::uint32_t leaves = leaf_count(tree);
  near_bound_.reserve(std::size_t{leaves} * bound_bytes_);
  near_.resize(std::size_t{leaves} * NEAR_MOST);
  near_count_.resize(leaves);
  list_
      .args(leaves, tree.seeds, tree.seed_count, tree.node_low, tree.node_high, tree.level_offset,
            cl_int{tree.levels}, seed_block_, node_block_, near_, near_count_, near_bound_)
      .submit(leaves);
}

void TreeBlocks::leave_empty() {
  for (cl::RawBuffer* buffer : {&seed_block_, &node_block_, &near_bound_}) buffer->reserve(0);
  near_.resize(0);
  near_count_.resize(0);
}

void TreeBlocks::append_pack_arguments(cl::Kernel& kernel, const Tree& tree) const {
  kernel.more_args(tree.seeds, tree.seed_count, tree.node_low, tree.node_high, tree.level_offset,
                   cl_int{tree.levels}, seed_block_, node_block_);
}

void TreeBlocks::append_arguments(cl::Kernel& kernel, const Tree& tree) const {
  append_pack_arguments(kernel, tree);
  kernel.more_args(near_, near_count_, near_bound_);
}

}  // namespace powercell
