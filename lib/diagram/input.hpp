/// \file
/// The seeds that a Diagram was given. Internal.
#pragma once

#include <powercell/seeds.hpp>
#include <span>
#include <vector>

#include "lib/diagram/setup.hpp"
#include "lib/seeds/seed_set.hpp"

namespace powercell {

/// Rows of positions and weights.
struct SeedRows {
  std::vector<double> positions, weights;
};

/// Checked seeds, without those that share their position with one of larger weight.
struct Input {
  SeedSet seeds;
  SeedRows duplicates;  ///< those left out, in the order of SeedSet::duplicate

  /// All seeds in the caller's order.
  SeedRows given() const;
};

/// \throw Error invalid_argument (sizes), invalid_seed: NaN or infinity, or so large that the square is not
/// finite (which seed and value)
Input make_input(const Setup& setup, const SeedsView& seeds);

/// The same seeds with n other weights. \throw Error invalid_argument (size), invalid_seed; then `input` is
/// as it was
Input with_weights(const Setup& setup, Input&& input, std::span<const double> weights);

}  // namespace powercell
