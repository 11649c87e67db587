/// \file
/// The pipeline of a DeviceDiagram, from device memory to device memory.
#pragma once

#include <optional>
#include <powercell/opencl.hpp>

#include "lib/device_diagram/density.hpp"
#include "lib/device_diagram/geometry.hpp"
#include "lib/device_diagram/repair.hpp"
#include "lib/device_diagram/walls.hpp"
#include "lib/neighbors/tree_blocks.hpp"
#include "lib/pairs/device_pairs.hpp"
#include "lib/periodic/device_images.hpp"
#include "lib/primitives/scan.hpp"

namespace powercell {

struct DeviceDiagram::State {
  State(Device device, Domain domain, Options options);

  std::size_t real_bytes() const { return precision == Precision::float32 ? sizeof(float) : sizeof(double); }

  void enqueue(cl_mem positions, cl_mem weights, std::uint32_t n, const DeviceResults& results, Rooms rooms,
               cl_event* done);
  /// As DeviceDiagram::set_density, of a checked buffer for a domain that can have one.
  void set_density(cl_mem values);
  cl_mem density() const { return density_ ? density_->values() : nullptr; }

  Device device;
  Domain domain;
  Options options;
  Precision precision;
  std::shared_ptr<const RegionMesh> room;  // of a periodic domain: the region of all cells; else null
  DomainBuffers domain_buffers;
  DeviceFacets facets;
  std::uint32_t pair_capacity = 0;     // 0: as many as needed
  std::uint32_t wall_capacity = 0;     // of the store; 0: by the number of pairs
  std::uint32_t image_capacity = 0;    // 0: as many as needed
  std::size_t first_capacity = 0;      // number of the smallest capacity to use
  std::optional<DeviceRepair> repair;  // made on first use

 private:
  void upload_frame();
  /// The kernels of all capacities, each tested with the golden diagram before its first use.
  std::vector<cl::Kernel> clip_kernels(bool with_density) const;
  /// Orders the seeds, and in a periodic domain their images behind them.
  void order_seeds(cl_mem positions, cl_mem weights, std::uint32_t n);
  TreeBlocks::Tree device_tree() const;
  /// The room of the store for `faces`, a sum of FACES_....
  std::uint32_t stored_walls(cl_uint faces) const;
  void clip(std::uint32_t n);
  /// Launches one capacity over all pairs, or over those in list_.
  void clip_with(std::size_t capacity, bool listed, std::uint32_t n);
  std::uint64_t launch_pairs() const;
  DeviceGeometry::Clipped clipped(std::uint32_t n) const;

  cl::RawBuffer frame_;
  DeviceSeeds seeds_;
  std::optional<DeviceImages> images_;  // in a periodic domain
  cl_mem points_ = nullptr;             // by rank, with images
  std::uint32_t points_count_ = 0;
  DeviceTree tree_;
  TreeBlocks blocks_;
  DevicePairs pairs_;
  DeviceWalls walls_;
  std::optional<DeviceGeometry> geometry_;  // made on first use
  std::optional<DeviceDensity> density_;    // the same
  Compaction compaction_;
  cl::Kernel finish_;
  std::vector<cl::Kernel> clip_;          // by number of the capacity
  std::vector<cl::Kernel> clip_density_;  // the same, made with density_
  cl::Buffer<std::uint32_t> piece_status_, list_, found_, for_host_;
  cl::RawBuffer moments_, reach_;
};

}  // namespace powercell
