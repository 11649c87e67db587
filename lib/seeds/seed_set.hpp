/// \file
/// The seeds as the stages use them: validated, without duplicates, in Hilbert order.
#pragma once

#include <cstdint>
#include <powercell/seeds.hpp>
#include <span>
#include <vector>

namespace powercell {

/// Unique seeds in Hilbert order. Everything between validation and the results works on `rank`s, the
/// positions in this order; `input[rank]` leads back to the caller's index.
struct SeedSet {
  int dimension = 0;
  std::size_t input_count = 0;           ///< seeds as given
  std::vector<double> positions;         ///< m x d, row-major, by rank
  std::vector<double> weights;           ///< m, by rank
  std::vector<std::uint32_t> input;      ///< m: index of the seed as given
  std::vector<std::uint32_t> duplicate;  ///< input indices left out, ascending
  std::size_t size() const { return input.size(); }
};

/// Validates, drops duplicates (equal positions: the largest weight stays, then the lowest index) and
/// orders the rest along a Hilbert curve (63-bit keys, ties by position and index, so that the order does not
/// depend on the number of threads). -0.0 and 0.0 are the same position.
/// \throw Error invalid_argument (sizes), invalid_seed (NaN or infinity, which seed and value)
SeedSet make_seed_set(const SeedsView& seeds, int dimension, int threads);

}  // namespace powercell
