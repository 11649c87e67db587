/// \file
/// Back from ordered seeds to the seeds as given. Internal.
#pragma once

#include <vector>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Rows of positions and weights.
struct GivenSeeds {
  std::vector<double> positions, weights;
};

/// Those that `set`, made of `seeds`, has left out, in the order of SeedSet::duplicate.
GivenSeeds duplicates_of(const SeedSet& set, const SeedsView& seeds);

/// All seeds by input index: those of `set` and its duplicates.
GivenSeeds given_seeds(const SeedSet& set, const std::vector<double>& duplicate_positions,
                       const std::vector<double>& duplicate_weights);

}  // namespace powercell
