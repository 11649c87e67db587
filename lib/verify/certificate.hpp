/// \file
/// The laws that are cheap enough to check on every result (Options::certify). Internal.
#pragma once

#include <functional>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The results to check; the caller owns them.
struct Certified {
  const Domain& domain;
  const SeedSet& seeds;
  const Measures& measures;
  const Adjacency* adjacency;  ///< may be null
  bool float32;
  int threads;
  std::function<const Cells&()> geometry = {};  ///< computes it, only if a law needs it; may be empty
};

/// Checks that the measures sum to that of the domain; that none is negative or NaN, and centroids lie in the
/// domain's box; that both sides of each wall agree; and that the owners of random points, found among all
/// seeds, have cells.
/// \throw Error internal, naming the law and the seeds concerned
void require_certificate(const Certified& result);

}  // namespace powercell
