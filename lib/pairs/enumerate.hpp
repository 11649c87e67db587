/// \file
/// Which seeds can meet which regions of the domain.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "lib/domain/region_mesh.hpp"
#include "lib/neighbors/packed_tree.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Candidate pairs by seed: rank i may meet the regions region[offset[i] .. offset[i+1]), ascending.
struct Pairs {
  std::vector<std::uint64_t> offset;  ///< seeds + 1
  std::vector<std::uint32_t> region;
};

/// A superset of the pairs with region and cell meeting in more than nothing, close to the true set:
/// seed i is left out for a region only if some j has pow_j < pow_i at all corners of each part of the
/// region (exact exclusion with a safe margin, so that rounding never loses a pair). A domain of one
/// region gives every seed. No quadratic work or memory: a million seeds in one region and ten seeds
/// on a million triangles are both near-linear. The result does not depend on `threads`.
/// \param progress as Options::progress
Pairs enumerate_pairs(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, int threads,
                      const std::function<bool(double)>& progress = {});

}  // namespace powercell
