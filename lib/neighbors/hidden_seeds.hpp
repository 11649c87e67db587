/// \file
/// Seeds that are proved hidden before any cell is clipped.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/scene/scene.hpp"

namespace powercell {

/// By rank: 1 if every point of the domain's bounding box is nearer, in power distance, to one of a few other
/// seeds (docs/mathematics.md, (10c); kernels/neighbors/hidden.cl), else 0. Seeds with 0 may be hidden too.
/// \pre more than PackedTree::fan seeds
/// \throw Error opencl, out_of_device_memory, build_failed
std::vector<std::uint8_t> hidden_seeds(const Scene& scene);
/// The same, or an empty vector where the search does not pay: few seeds, or few hidden ones in a sample.
std::vector<std::uint8_t> hidden_seeds_if_many(const Scene& scene);

/// Whether many seeds are likely hidden, by an estimate from neighbours in their order.
bool may_hide_many(const SeedSet& seeds);

/// The seeds for which `hidden`, by rank, is 0, in their order.
SeedSet without_hidden(const SeedSet& seeds, const std::vector<std::uint8_t>& hidden, int threads);

}  // namespace powercell
