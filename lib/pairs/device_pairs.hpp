/// \file
/// Which seeds can meet which regions, found on the device. Internal.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/primitives/scan.hpp"
#include "lib/scene/domain_buffers.hpp"
#include "lib/seeds/device_seeds.hpp"
#include "lib/seeds/device_tree.hpp"

namespace powercell {

/// Candidate pairs in device memory, by seed. A superset of the true ones, as Pairs on the host, though not
/// the same one. All members are buffers that grow and are kept.
class DevicePairs {
 public:
  /// Work-items are numbered with 32 bits, also those that only fill a group.
  static constexpr std::uint32_t most_pairs = 0xffff0000u;

  /// Uploads the tree of the regions and builds the kernels; this waits.
  /// \param domain  its regions are read, also in enqueue()
  DevicePairs(const DomainBuffers& domain, const std::vector<std::string>& defines);

  /// Enqueues the search. A domain of one region has all its pairs; of several, their number is read back,
  /// which waits for the queue, unless `most` says how many there is room for: of more, the last are left
  /// out. \param n     seeds, at least 1  \param most  0 to read the number \throw Error out_of_device_memory
  /// (2^32 - 1 pairs or more, too), opencl
  void enqueue(const DeviceSeeds& seeds, const DeviceTree& tree, std::uint32_t n, std::uint32_t most);

  cl::Buffer<std::uint32_t> seed;  ///< rank
  cl::Buffer<std::uint32_t> region;
  cl::Buffer<std::uint64_t>
      offset;                  ///< n + 1: the pairs of a rank are consecutive; the last one is their number
  std::uint32_t capacity = 0;  ///< room in seed and region

 private:
  /// The regions' packed tree, and the seed that owns the middle of each region and node.
  struct RegionTree {
    RegionTree(const DomainBuffers& domain, const std::vector<std::string>& defines);
    std::uint32_t count = 0;
    cl::Buffer<std::uint32_t> region;  ///< in curve order
    cl::RawBuffer low, high;           ///< seed_t: boxes, in curve order
    DeviceTree nodes;
    cl::Buffer<std::uint32_t> owner, node_owner;
    cl::Kernel find_owners, find_pairs;
  };

  void reserve(std::uint32_t pairs);
  void find_owners(const DeviceSeeds& seeds, const DeviceTree& tree, std::uint32_t n);
  void find(const DeviceSeeds& seeds, const DeviceTree& tree, std::uint32_t n, bool write);
  std::uint32_t read_number(std::uint32_t n) const;

  const DomainBuffers& domain_;
  std::optional<RegionTree> regions_;   // for several regions
  std::optional<cl::Kernel> pair_all_;  // for one
  ExclusiveScan scan_;
};

}  // namespace powercell
