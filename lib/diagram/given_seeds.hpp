/// \file
/// The seeds of a Diagram, as given by the caller.
#pragma once

#include <optional>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

#include "lib/diagram/setup.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Where seeds of a periodic domain were before they were wrapped.
struct Unwrapped {
  std::vector<double> positions;  ///< in the caller's order, as given
  std::vector<Shift> shift;       ///< by the caller's index: from the wrapped seed, in the vectors as given
};

/// Rows of positions and weights.
struct SeedRows {
  std::vector<double> positions, weights;
};

/// Validated seeds in Hilbert order, and the duplicates left out of them.
struct GivenSeeds {
  SeedSet seeds;
  SeedRows duplicates;                      ///< in the order of SeedSet::duplicate
  std::optional<Unwrapped> unwrapped = {};  ///< in a periodic domain, where the others are wrapped

  /// All seeds as given, in the caller's order.
  SeedRows given() const;
};

/// \throw Error invalid_argument (sizes); invalid_seed (NaN, infinity, a square that overflows, or more than
/// 2^28
///        periods outside; names seed and value)
GivenSeeds make_given_seeds(const DiagramSetup& setup, const SeedsView& seeds);

/// The first seed that make_given_seeds() refuses, in the order in which it looks for them: all that are not
/// finite come before all positions, and these before all weights, that are too large. In a periodic domain
/// positions that are too far outside count as these.
struct InputFault {
  int order = 0;  ///< of its kind
  SeedFault fault;
};
std::optional<InputFault> first_fault(const DiagramSetup& setup, const SeedsView& seeds);

/// The same seeds with new weights, in the caller's order.
/// \throw Error invalid_argument (size), invalid_seed; `input` is then unchanged
GivenSeeds with_weights(const DiagramSetup& setup, GivenSeeds&& input, std::span<const double> weights);

}  // namespace powercell
