/// \file
/// The pipeline from device memory to device memory. Internal.
#pragma once

#include <powercell/opencl.hpp>

#include "lib/neighbors/tree_blocks.hpp"
#include "lib/pairs/device_pairs.hpp"
#include "lib/primitives/compaction.hpp"

namespace powercell {

struct DeviceDiagram::State {
  State(Device device, Domain domain, Options options);

  void enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, cl_mem measures, cl_mem status,
               cl_event* done);

  Device device;
  Domain domain;
  Options options;
  Precision precision;
  DomainBuffers domain_buffers;
  std::uint32_t pair_capacity = 0;  // 0: as many as there are
  std::size_t first_capacity = 0;   // the smallest that is used

 private:
  void upload_frame();
  /// The program of a capacity; computes a known diagram with it if it has not yet.
  void add_capacity(std::size_t capacity);
  TreeBlocks::Tree device_tree(std::uint32_t n) const;
  void clip(std::uint32_t n);
  /// One capacity over all pairs, or over those listed.
  void clip_with(std::size_t capacity, bool listed, std::uint32_t n);

  cl::RawBuffer frame_;
  DeviceSeeds seeds_;
  DeviceTree tree_;
  TreeBlocks blocks_;
  DevicePairs pairs_;
  Compaction compaction_;
  cl::Kernel finish_;
  std::vector<cl::Kernel> clip_;  // per capacity
  cl::Buffer<std::uint32_t> piece_status_, list_, found_;
  cl::RawBuffer moments_;
};

}  // namespace powercell
