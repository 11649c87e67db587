/// \file
/// Stable sort of keyed indices.
#pragma once

#include <cstdint>
#include <span>

namespace powercell {

struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

/// Sorts `records` by key; records of equal key keep their order. `scratch` has the size of `records`.
void sort_by_key(std::span<KeyedIndex> records, std::span<KeyedIndex> scratch, int threads);

}  // namespace powercell
