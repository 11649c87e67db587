/// \file
/// The packed tree in blocks of eight, and the near leaves of each leaf, in device memory.
#pragma once

#include <cstdint>
#include <memory>

#include "lib/cl/program.hpp"

namespace powercell {

struct BlockBuffers;
struct Variant;

/// The structure that the clip kernels search, built on the device from seeds and tree
/// (kernels/neighbors/blocks.cl, near.cl).
class TreeBlocks {
 public:
  /// Builds the kernels for the precision and dimensions of `variant`.
  /// \param buffers  receive the blocks
  TreeBlocks(const std::shared_ptr<cl::Context>& context, const Variant& variant,
             std::shared_ptr<BlockBuffers> buffers);

  /// A packed tree in device memory, of at least one seed.
  struct Tree {
    cl_mem seeds, node_low, node_high;  ///< seed_t
    cl_mem level_offset;
    std::uint32_t seed_count, node_count;
    int levels;
  };
  /// Enqueues both steps, without waiting.
  /// \param cells  only these first seeds have cells; by default all
  void enqueue(const Tree& tree) { enqueue(tree, tree.seed_count); }
  void enqueue(const Tree& tree, std::uint32_t cells) {
    pack(tree);
    list(tree, cells);
  }
  void pack(const Tree& tree);  ///< the blocks
  void list(const Tree& tree) { list(tree, tree.seed_count); }
  void list(const Tree& tree, std::uint32_t cells);  ///< the near leaves, from the blocks
  /// Allocates the buffers, for kernels that take the arguments but do not search.
  void allocate();

  /// Appends the arguments of clip kernels: tree, blocks and near leaves.
  void append_arguments(cl::Kernel& kernel, const Tree& tree) const;
  /// Appends the same without the near leaves.
  void append_pack_arguments(cl::Kernel& kernel, const Tree& tree) const;

 private:
  cl::Kernel pack_, list_;
  std::size_t row_bytes_, bound_bytes_, dimension_;
  std::shared_ptr<BlockBuffers> buffers_;
};

}  // namespace powercell
