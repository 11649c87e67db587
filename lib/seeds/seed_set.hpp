/// \file
/// The seeds as the stages use them: checked, without duplicates, in Hilbert order.
#pragma once

#include <cstdint>
#include <optional>
#include <powercell/seeds.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell {

/// Unique seeds in Hilbert order. Every stage between the checks and the results works on ranks, the indices
/// in this order; `input[rank]` is the caller's index.
struct SeedSet {
  int dimension = 0;
  std::size_t input_count = 0;           ///< seeds as given, duplicates included
  std::vector<double> positions;         ///< m x d, row-major, by rank
  std::vector<double> weights;           ///< m, by rank
  std::vector<std::uint32_t> input;      ///< m: index of the seed as given
  std::vector<std::uint32_t> duplicate;  ///< input indices of the seeds left out, ascending
  std::size_t size() const { return input.size(); }
};

/// Checks the seeds, drops duplicates and orders the rest along a Hilbert curve. Of the seeds at one position
/// (-0.0 equals 0.0) the one of largest weight stays, of those the one of lowest index. Keys have 63 bits;
/// equal keys are ordered by position, then index, so the order does not depend on the number of threads.
/// \throw Error invalid_argument (dimension, sizes), invalid_seed (the first seed with a NaN or infinity)
SeedSet make_seed_set(const SeedsView& seeds, int dimension, int threads);

/// Why a diagram refuses a seed.
struct SeedFault {
  std::size_t seed = 0;
  std::string why;
};
/// The first seed with a NaN or infinity.
std::optional<SeedFault> first_not_finite(const SeedsView& seeds, int threads);
/// \param name  of the seed: its number
/// \throw Error invalid_seed
[[noreturn]] void refuse_seed(std::uint64_t name, const std::string& why);

/// \throw Error invalid_argument (dimension, sizes)
void check_sizes(const SeedsView& seeds, int dimension);

/// \throw Error invalid_argument (dimension, sizes), invalid_seed (the first seed with a NaN or infinity)
void check_seeds(const SeedsView& seeds, int dimension, int threads);

/// \throw Error invalid_seed (the first seed whose weight is NaN or infinite)
void check_weights(std::span<const double> weights, int threads);

}  // namespace powercell
