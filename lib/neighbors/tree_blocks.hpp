/// \file
/// The packed tree in blocks of eight, and the near leaves of each leaf, in device memory. Internal.
#pragma once

#include <cstdint>

#include "lib/cl/program.hpp"

namespace powercell {

struct Variant;

/// The structure that the clip kernels search, built on the device from seeds and tree
/// (kernels/neighbors/blocks.cl, near.cl).
class TreeBlocks {
 public:
  /// Builds the kernels for the precision and dimensions of `variant`.
  TreeBlocks(const std::shared_ptr<cl::Context>& context, const Variant& variant);

  /// A packed tree in device memory, of at least one seed.
  struct Tree {
    cl_mem seeds, node_low, node_high;  ///< seed_t
    cl_mem level_offset;
    std::uint32_t seed_count, node_count;
    int levels;
  };
  /// Enqueues both steps, without waiting.
  void enqueue(const Tree& tree) {
    pack(tree);
    list(tree);
  }
  void pack(const Tree& tree);  ///< the blocks
  void list(const Tree& tree);  ///< the near leaves, from the blocks
  /// Leaves the buffers empty, for kernels that take the arguments but do not search.
  void leave_empty();

  /// Appends the arguments of clip kernels: tree, blocks and near leaves.
  void append_arguments(cl::Kernel& kernel, const Tree& tree) const;
  /// Appends the same without the near leaves.
  void append_pack_arguments(cl::Kernel& kernel, const Tree& tree) const;

 private:
  cl::Kernel pack_, list_;
  std::size_t row_bytes_, bound_bytes_, dimension_;
  cl::RawBuffer seed_block_, node_block_, near_bound_;
  cl::Buffer<std::uint32_t> near_, near_count_;
};

}  // namespace powercell
