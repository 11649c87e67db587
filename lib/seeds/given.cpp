#include "lib/seeds/given.hpp"

#include <algorithm>

namespace powercell {
namespace {

/// Copies row `from` of positions and weights to row `to`.
void copy_row(int dimension, const double* positions, const double* weights, std::size_t from,
              GivenSeeds& rows, std::size_t to) {
  const auto d = static_cast<std::size_t>(dimension);
  std::copy_n(positions + from * d, d, rows.positions.data() + to * d);
  rows.weights[to] = weights ? weights[from] : 0.0;
}

GivenSeeds with_room(int dimension, std::size_t count) {
  return {std::vector<double>(count * static_cast<std::size_t>(dimension)), std::vector<double>(count)};
}

}  // namespace

GivenSeeds duplicates_of(const SeedSet& set, const SeedsView& seeds) {
  GivenSeeds rows = with_room(set.dimension, set.duplicate.size());
  const double* const weights = seeds.weights.empty() ? nullptr : seeds.weights.data();
  for (std::size_t k = 0; k < set.duplicate.size(); ++k)
    copy_row(set.dimension, seeds.positions.data(), weights, set.duplicate[k], rows, k);
  return rows;
}

GivenSeeds given_seeds(const SeedSet& set, const std::vector<double>& duplicate_positions,
                       const std::vector<double>& duplicate_weights) {
  GivenSeeds rows = with_room(set.dimension, set.input_count);
  for (std::size_t rank = 0; rank < set.size(); ++rank)
    copy_row(set.dimension, set.positions.data(), set.weights.data(), rank, rows, set.input[rank]);
  for (std::size_t k = 0; k < set.duplicate.size(); ++k)
    copy_row(set.dimension, duplicate_positions.data(), duplicate_weights.data(), k, rows, set.duplicate[k]);
  return rows;
}

}  // namespace powercell
