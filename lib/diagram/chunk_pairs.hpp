/// \file
/// How many pairs are clipped at a time. Internal.
#pragma once

#include <cstdint>

#include "lib/diagram/setup.hpp"

namespace powercell {

inline constexpr std::uint64_t least_chunk_pairs = 1024;

enum class ChunkOf { cells, facets };  ///< clips cells, or the boundary triangles of a solid by cells

/// The number of pairs of a chunk, of `total`.
std::uint64_t chunk_pairs(const Setup& setup, std::uint64_t total, ChunkOf what = ChunkOf::cells);

}  // namespace powercell
