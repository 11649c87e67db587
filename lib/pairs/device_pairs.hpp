/// \file
/// Finds on the device which seeds can meet which regions.
#pragma once

#include <cstdint>
#include <optional>

#include "lib/primitives/scan.hpp"
#include "lib/scene/domain_buffers.hpp"
#include "lib/seeds/device_seeds.hpp"
#include "lib/seeds/device_tree.hpp"

namespace powercell {

/// Candidate pairs in device memory, by seed: a superset of the true ones, like Pairs, but not the same set.
/// The buffers grow as needed and are reused.
class DevicePairs {
 public:
  /// Work-items have 32-bit numbers, including those that pad the last group.
  static constexpr std::uint32_t most_pairs = 0xffff0000u;

  /// Uploads the tree of the regions and builds the kernels, and waits for both.
  /// \param domain  must outlive this
  DevicePairs(const DomainBuffers& domain, const std::vector<std::string>& defines);

  /// Enqueues the search. With several regions it reads back the number of pairs, which waits for the queue,
  /// unless `most` is given.
  /// \param n     number of seeds, at least 1
  /// \param most  number of pairs to make room for, beyond which they are dropped; 0 to read the number
  /// \throw Error opencl; out_of_device_memory, also if there are more than most_pairs
  void enqueue(const DeviceSeeds& seeds, const DeviceTree& tree, std::uint32_t n, std::uint32_t most);

  cl::Buffer<std::uint32_t> seed;    ///< rank
  cl::Buffer<std::uint32_t> region;  ///< per pair
  cl::Buffer<std::uint64_t> offset;  ///< n + 1: first pair of each rank, then the number of pairs
  std::uint32_t capacity = 0;        ///< of `seed` and `region`

 private:
  /// The packed tree of the regions, and the owner of the middle of each region and node.
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
