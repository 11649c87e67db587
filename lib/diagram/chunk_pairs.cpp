#include "lib/diagram/chunk_pairs.hpp"

#include <algorithm>

#include "lib/cl/context.hpp"
#include "lib/cl/quirks.hpp"

namespace powercell {
namespace {

/// Vertices and faces of a chunk have 32-bit numbers, and a pair at most some 750 of them.
constexpr std::uint64_t most_chunk_pairs = std::uint64_t{1} << 22;

}  // namespace

std::uint64_t chunk_pairs(const Setup& setup, const Device& device, std::uint64_t total) {
  if (setup.options.chunk_pairs > 0) return std::min(setup.options.chunk_pairs, most_chunk_pairs);
  const std::uint64_t most =
      std::min(device.context()->settings().chunk_pairs, cl::quirks_of(device.info()).launch_limit);
  if (total == 0) return most;
  // Chunks of equal size, because a small last chunk would not keep all cores busy.
  return (total - 1) / ((total - 1) / most + 1) + 1;
}

}  // namespace powercell
