/// \file
/// Pairs by definition, to check the search for pairs.
#pragma once

#include <set>
#include <utility>

#include "lib/pairs/pair_finder.hpp"

namespace powercell::test {

using PairSet = std::set<std::pair<std::uint32_t, std::uint32_t>>;  // region, rank

/// The pairs whose intersection has a positive measure: every region against every seed, cut by the
/// bisectors with all other seeds, in long double.
PairSet true_pairs(const RegionMesh& mesh, const SeedSet& seeds);

PairSet as_set(const Pairs& pairs);

}  // namespace powercell::test
