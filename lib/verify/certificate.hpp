/// \file
/// The laws that are cheap enough to be checked on every result (Options::certify). Internal.
#pragma once

#include <functional>
#include <powercell/domain.hpp>
#include <powercell/results.hpp>

#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// What a certificate looks at; owned by the caller.
struct Certified {
  const Domain& domain;
  const SeedSet& seeds;
  const Measures& measures;
  const Adjacency* adjacency;  ///< or none
  bool float32;
  int threads;
  std::function<const Cells&()> geometry = {};  ///< computes it; asked for where a law needs it, or none
};

/// Partition of the measure; measures that are numbers and not negative, and centroids in the domain's box;
/// walls that both sides measure alike; random points whose seed of least power, found by trying all, is not
/// said to be hidden. \throw Error internal with the law and the seeds concerned
void require_certificate(const Certified& result);

}  // namespace powercell
