#include "lib/diagram/chunk_pairs.hpp"

#include <algorithm>

#include "lib/cl/quirks.hpp"

namespace powercell {
namespace {

/// Pairs of a chunk, unless Options::chunk_pairs is set. A GPU needs many to be busy. A core of a CPU needs a
/// few groups, and collects the output of a small chunk from its cache.
constexpr std::uint64_t chunk_pairs_gpu = std::uint64_t{1} << 18, chunk_pairs_core = std::uint64_t{1} << 14;
/// Vertices and faces of a chunk have 32-bit numbers, and a pair at most some 750 of them.
constexpr std::uint64_t most_chunk_pairs = std::uint64_t{1} << 22;

}  // namespace

std::uint64_t chunk_pairs(const Setup& setup, std::uint64_t total) {
  if (setup.options.chunk_pairs > 0) return std::min(setup.options.chunk_pairs, most_chunk_pairs);
  const DeviceInfo& device = setup.device.info();
  const std::uint64_t busy = device.type != DeviceInfo::Type::cpu
                                 ? chunk_pairs_gpu
                                 : std::max(1u, device.compute_units) * chunk_pairs_core;
  const std::uint64_t most = std::min(busy, cl::quirks_of(device).launch_limit);
  if (total == 0) return most;
  // Chunks of equal size, because a small last chunk would not keep all cores busy.
  return (total - 1) / ((total - 1) / most + 1) + 1;
}

}  // namespace powercell
