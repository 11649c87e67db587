/// \file
/// Seeds without a cell, found out before any cell is clipped. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/clip/scene.hpp"

namespace powercell {

/// For each rank 1 if it is certain that the seed has no cell in the box around the domain, since a few seeds
/// nearby beat it everywhere there (docs/mathematics.md, "Hidden seeds"; kernels/neighbors/hidden.cl), else
/// 0. \pre more than PackedTree::fan seeds
std::vector<std::uint8_t> hidden_seeds(const Scene& scene);
/// The same, or nothing where it is not worth the time: few seeds, all weights alike, or few of a sample
/// hidden.
std::vector<std::uint8_t> hidden_seeds_if_many(const Scene& scene);

/// The others, in their order.
SeedSet without_hidden(const SeedSet& seeds, const std::vector<std::uint8_t>& hidden, int threads);

}  // namespace powercell
