/// \file
/// Chunks of pairs, of which the device clips one while the host completes another. Internal.
#pragma once

#include <cstdint>
#include <future>
#include <optional>
#include <span>
#include <vector>

#include "lib/clip/clipper.hpp"

namespace powercell {

/// The pairs [begin, end) of a plan, and what clips them.
struct ClipChunk {
  std::uint64_t begin = 0, end = 0;
  std::vector<std::uint32_t> pair_row;       ///< of each pair
  std::vector<std::uint32_t> selected_seed;  ///< the same by rank, if cells are selected
  std::span<const std::uint32_t> pair_seed;  ///< the same by rank
  std::optional<Clipper> clipper;
  /// Of a chunk that is being clipped on the device: the pairs to finish on the host. Declared last: its end
  /// waits for the thread that uses all the others.
  std::future<std::vector<std::uint32_t>> for_host;

  bool is_of(std::uint64_t first, std::uint64_t last) const {
    return for_host.valid() && begin == first && end == last;
  }
  /// Waits for a chunk that is being clipped and drops its results, or its failure.
  void drop() {
    if (!for_host.valid()) return;
    for_host.wait();
    for_host = {};
  }
};

}  // namespace powercell
