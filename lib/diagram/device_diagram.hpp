/// \file
/// The pipeline from device memory to device memory. Internal.
#pragma once

#include <powercell/opencl.hpp>

#include "lib/clip/scene.hpp"
#include "lib/neighbors/device_tree.hpp"
#include "lib/primitives/compaction.hpp"
#include "lib/seeds/device_seeds.hpp"

namespace powercell {

/// Pairs in device memory, by seed (as Pairs on the host).
struct DevicePairs {
  explicit DevicePairs(const std::shared_ptr<cl::Context>& context)
      : seed(context), region(context), offset(context) {}
  cl::Buffer<std::uint32_t> seed;  ///< rank
  cl::Buffer<std::uint32_t> region;
  cl::Buffer<std::uint64_t> offset;  ///< seeds + 1; the last one is how many there are
  std::uint32_t capacity = 0;        ///< room in seed and region
};

struct DeviceDiagram::State {
  State(Device device, Domain domain, Options options);

  void enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, cl_mem measures, cl_mem status,
               cl_event* done);

  Device device;
  Domain domain;
  Options options;
  Precision precision;
  Scene scene;

 private:
  void upload_frame();
  void find_pairs(std::uint32_t n);
  void clip(std::uint32_t n);
  /// One rung over all pairs, or over those listed.
  void clip_rung(std::size_t rung, bool listed, std::uint32_t n);

  cl::RawBuffer frame_;
  DeviceSeeds seeds_;
  DeviceTree tree_;
  DevicePairs pairs_;
  Compaction compaction_;
  cl::Kernel pair_all_, finish_;
  std::vector<cl::Kernel> clip_;  // per rung
  cl::Buffer<std::uint32_t> piece_status_, list_, found_;
  cl::RawBuffer moments_;
};

}  // namespace powercell
