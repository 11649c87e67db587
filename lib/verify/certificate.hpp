/// \file
/// The laws that are cheap enough to check on every result (Options::certify).
#pragma once

#include <functional>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// The results to certify; owned by the caller.
struct Certified {
  const Domain& domain;
  const SeedSet& seeds;
  const SeedSet& owners;  ///< the seeds, in a periodic domain with their images
  const Measures& measures;
  const Adjacency* adjacency;  ///< may be null
  bool float32;
  int threads;
  std::function<const Cells&()> geometry = {};  ///< computes the cells where a law needs them; may be empty
};

/// Checks that the measures sum to the domain's, are numbers and not negative, that centroids lie in the
/// domain's box (unless it is periodic), that both sides of a wall have the same measure, and that the seed
/// of least power distance at some random points, found by trying all seeds, is not hidden.
/// \throw Error internal with the law and the seeds concerned
void require_certificate(const Certified& result);

}  // namespace powercell
