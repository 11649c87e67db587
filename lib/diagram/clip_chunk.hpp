/// \file
/// A chunk of pairs, and what clips it. Internal.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lib/clip/clipper.hpp"
#include "lib/diagram/plan.hpp"

namespace powercell {

struct ClipChunk {
  std::uint64_t begin = 0, end = 0;          ///< of the pairs of a plan
  std::vector<std::uint32_t> pair_row;       ///< of each pair
  std::vector<std::uint32_t> selected_seed;  ///< the same by rank, if cells are selected
  std::span<const std::uint32_t> pair_seed;  ///< the same by rank
  std::span<const std::uint32_t> pair_region;
  std::optional<Clipper> clipper;
  std::vector<std::uint32_t> for_host;  ///< once the device has clipped the chunk: the pairs to finish here

  /// Makes this the pairs [first, last) of a plan, which must not be empty.
  void set_pairs(const Plan& plan, std::uint64_t first, std::uint64_t last);
  /// Sets pair_seed from pair_row.
  void set_seeds(const Plan& plan);
};

}  // namespace powercell
