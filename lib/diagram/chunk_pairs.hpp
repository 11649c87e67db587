/// \file
/// How many pairs are clipped at a time. Internal.
#pragma once

#include <cstdint>

#include "lib/diagram/setup.hpp"

namespace powercell {

inline constexpr std::uint64_t least_chunk_pairs = 1024;

/// The number of pairs of a chunk on one device, of `total`; 0 pairs stand for very many.
std::uint64_t chunk_pairs(const Setup& setup, const Device& device, std::uint64_t total);

}  // namespace powercell
