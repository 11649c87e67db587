/// \file
/// Seeds without a cell, found out before any cell is clipped. Internal.
#pragma once

#include <cstdint>
#include <vector>

#include "lib/scene/scene.hpp"

namespace powercell {

/// For each rank of scene.seeds 1 if it is certain that the seed has no cell in the box around the domain,
/// since a few seeds nearby beat it everywhere there (docs/mathematics.md, "Hidden seeds";
/// kernels/neighbors/hidden.cl), else 0. \pre more than PackedTree::fan seeds   \throw Error opencl,
/// out_of_device_memory, build_failed
std::vector<std::uint8_t> hidden_seeds(const Scene& scene);
/// The same, or nothing where it is not worth the time: few seeds, or few that seem to be hidden.
std::vector<std::uint8_t> hidden_seeds_if_many(const Scene& scene);

/// The seeds whose `hidden`, by rank, is 0, in their order.
SeedSet without_hidden(const SeedSet& seeds, const std::vector<std::uint8_t>& hidden, int threads);

}  // namespace powercell
