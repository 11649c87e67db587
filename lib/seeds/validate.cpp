#include "lib/seeds/validate.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <powercell/error.hpp>
#include <string>

#include "kernels/layout.h"
#include "lib/base/threads.hpp"

namespace powercell {
namespace {

static_assert(most_seeds_of_diagram <= BORDER_PLANE,
              "ranks of neighbours are borders of cells below that of planes");

/// Index of the first value that is NaN or infinite, or values.size().
std::size_t first_not_finite(std::span<const double> values, int threads) {
  return first_of(values.size(), threads, [&](std::size_t k) { return !std::isfinite(values[k]); });
}

void check_sizes(const SeedsView& seeds, int dimension) {
  if (dimension != 2 && dimension != 3)
    throw Error(ErrorCode::invalid_argument, "dimension must be 2 or 3, not " + std::to_string(dimension));
  if (seeds.dimension != dimension)
    throw Error(ErrorCode::invalid_argument,
                "seeds have " + std::to_string(seeds.dimension) + " coordinates each, the domain has " +
                    std::to_string(dimension) + "; give seeds of the domain's dimension");
  const std::size_t d = static_cast<std::size_t>(dimension);
  if (seeds.positions.size() % d != 0)
    throw Error(ErrorCode::invalid_argument, std::to_string(seeds.positions.size()) +
                                                 " coordinates are not a multiple of the dimension " +
                                                 std::to_string(dimension));
  if (!seeds.weights.empty() && seeds.weights.size() != seeds.size())
    throw Error(ErrorCode::invalid_argument, std::to_string(seeds.weights.size()) + " weights for " +
                                                 std::to_string(seeds.size()) +
                                                 " seeds; give one for each seed, or none for all zero");
  if (seeds.size() > most_seeds_of_diagram)
    throw Error(ErrorCode::invalid_argument, std::to_string(seeds.size()) + " seeds are more than the " +
                                                 std::to_string(most_seeds_of_diagram) +
                                                 " that one diagram can have");
}

std::string spelled(double value) {
  if (std::isnan(value)) return "NaN";
  return value > 0 ? "infinity" : "-infinity";
}

[[noreturn]] void refuse_weight(std::span<const double> weights, std::size_t seed) {
  throw Error(ErrorCode::invalid_seed, "seed " + std::to_string(seed) + ": weight is " +
                                           spelled(weights[seed]) +
                                           "; weights must be finite, correct or remove this seed");
}

}  // namespace

void validate_weights(std::span<const double> weights, int threads) {
  const std::size_t seed = first_not_finite(weights, threads);
  if (seed < weights.size()) refuse_weight(weights, seed);
}

void validate_seeds(const SeedsView& seeds, int dimension, int threads) {
  check_sizes(seeds, dimension);
  const std::size_t d = static_cast<std::size_t>(dimension);
  const std::size_t position = first_not_finite(seeds.positions, threads);
  const std::size_t weight = first_not_finite(seeds.weights, threads);
  const bool bad_position = position < seeds.positions.size();
  const bool bad_weight = weight < seeds.weights.size();
  if (bad_position && (!bad_weight || position / d <= weight))
    throw Error(ErrorCode::invalid_seed, "seed " + std::to_string(position / d) + ": coordinate " +
                                             "xyz"[position % d] + " is " +
                                             spelled(seeds.positions[position]) +
                                             "; coordinates must be finite, correct or remove this seed");
  if (bad_weight) refuse_weight(seeds.weights, weight);
}

}  // namespace powercell
