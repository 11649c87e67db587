#include "lib/seeds/seed_set.hpp"

#include <algorithm>
#include <cmath>
#include <powercell/error.hpp>
#include <string>

#include "kernels/layout.h"
#include "lib/base/memory.hpp"
#include "lib/base/positions.hpp"
#include "lib/base/threads.hpp"
#include "lib/seeds/hilbert.hpp"

namespace powercell {
namespace {

static_assert(most_seeds_of_diagram < ENTRY_FACET, "ranks of neighbours are borders from 0 on, of 32 bits");

/// Index of the first value that is NaN or infinite, or values.size().
std::size_t first_bad(std::span<const double> values, int threads) {
  return first_of(values.size(), threads, [&](std::size_t k) { return !std::isfinite(values[k]); });
}

std::string spelled(double value) {
  if (std::isnan(value)) return "NaN";
  return value > 0 ? "infinity" : "-infinity";
}

std::string weight_fault(double weight) {
  return "weight is " + spelled(weight) + "; weights must be finite: correct or remove this seed";
}

/// Positions and weights in the order of `set.input`.
void gather(const SeedsView& seeds, int threads, SeedSet& set) {
  const auto d = static_cast<std::size_t>(set.dimension);
  resize_populated(set.positions, set.size() * d, threads);
  resize_populated(set.weights, set.size(), threads);
  parallel_for(threads_for(set.size(), threads), set.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t rank = begin; rank < end; ++rank) {
      const std::size_t i = set.input[rank];
      copy_point(&seeds.positions[i * d], d, &set.positions[rank * d]);
      set.weights[rank] = seeds.weights.empty() ? 0.0 : seeds.weights[i];
    }
  });
}

/// Whether two seeds of consecutive rank are at the same position.
bool has_duplicates(const SeedSet& set, int threads) {
  if (set.size() < 2) return false;
  const auto d = static_cast<std::size_t>(set.dimension);
  const auto at_next = [&](std::size_t rank) {
    const double* const p = &set.positions[rank * d];
    return std::equal(p, p + d, p + d);
  };
  return first_of(set.size() - 1, threads, at_next) < set.size() - 1;
}

/// Leaves one seed of each position in `order`, in which seeds at equal positions are consecutive: the one of
/// largest weight, of those the lowest index. Returns the indices left out, ascending.
std::vector<std::uint32_t> drop_duplicates(const SeedsView& seeds, std::vector<std::uint32_t>& order) {
  const std::size_t d = static_cast<std::size_t>(seeds.dimension);
  const auto weight = [&](std::uint32_t i) { return seeds.weights.empty() ? 0.0 : seeds.weights[i]; };
  const auto same_position = [&](std::uint32_t i, std::uint32_t j) {
    const double* p = &seeds.positions[i * d];
    const double* q = &seeds.positions[j * d];
    return std::equal(p, p + d, q);
  };
  std::vector<std::uint32_t> dropped;
  std::size_t kept = 0;
  for (const std::uint32_t i : order) {
    if (kept == 0 || !same_position(order[kept - 1], i)) {
      order[kept++] = i;
      continue;
    }
    std::uint32_t& winner = order[kept - 1];
    const bool better = weight(i) > weight(winner) || (weight(i) == weight(winner) && i < winner);
    dropped.push_back(better ? winner : i);
    if (better) winner = i;
  }
  order.resize(kept);
  std::sort(dropped.begin(), dropped.end());
  return dropped;
}

}  // namespace

void check_sizes(const SeedsView& seeds, int dimension) {
  if (dimension != 2 && dimension != 3)
    throw Error(ErrorCode::invalid_argument, "dimension must be 2 or 3, not " + std::to_string(dimension));
  if (seeds.dimension != dimension)
    throw Error(ErrorCode::invalid_argument,
                "seeds have " + std::to_string(seeds.dimension) + " coordinates each, the domain has " +
                    std::to_string(dimension) + "; give seeds of the domain's dimension");
  const std::size_t d = static_cast<std::size_t>(dimension);
  if (seeds.positions.size() % d != 0)
    throw Error(ErrorCode::invalid_argument,
                "the number of coordinates, " + std::to_string(seeds.positions.size()) +
                    ", is not a multiple of the dimension " + std::to_string(dimension));
  if (!seeds.weights.empty() && seeds.weights.size() != seeds.size())
    throw Error(ErrorCode::invalid_argument, std::to_string(seeds.weights.size()) + " weights for " +
                                                 std::to_string(seeds.size()) +
                                                 " seeds; give one for each seed, or none for all zero");
  if (seeds.size() > most_seeds_of_diagram)
    throw Error(ErrorCode::invalid_argument, std::to_string(seeds.size()) +
                                                 " seeds are more than the limit of " +
                                                 std::to_string(most_seeds_of_diagram) + " for one diagram");
}

std::optional<SeedFault> first_not_finite(const SeedsView& seeds, int threads) {
  const std::size_t d = static_cast<std::size_t>(seeds.dimension);
  const std::size_t position = first_bad(seeds.positions, threads);
  const std::size_t weight = first_bad(seeds.weights, threads);
  const bool bad_position = position < seeds.positions.size();
  const bool bad_weight = weight < seeds.weights.size();
  if (bad_position && (!bad_weight || position / d <= weight))
    return SeedFault{position / d, std::string("coordinate ") + "xyz"[position % d] + " is " +
                                       spelled(seeds.positions[position]) +
                                       "; coordinates must be finite: correct or remove this seed"};
  if (bad_weight) return SeedFault{weight, weight_fault(seeds.weights[weight])};
  return {};
}

void refuse_seed(std::uint64_t name, const std::string& why) {
  throw Error(ErrorCode::invalid_seed, "seed " + std::to_string(name) + ": " + why);
}

void check_seeds(const SeedsView& seeds, int dimension, int threads) {
  check_sizes(seeds, dimension);
  if (const std::optional<SeedFault> fault = first_not_finite(seeds, threads))
    refuse_seed(fault->seed, fault->why);
}

SeedSet make_seed_set(const SeedsView& seeds, int dimension, int threads) {
  const int workers = thread_count(threads);
  check_seeds(seeds, dimension, workers);

  SeedSet set;
  set.dimension = dimension;
  set.input_count = seeds.size();
  set.input = hilbert_order(seeds.positions, dimension, workers);
  gather(seeds, workers, set);
  if (has_duplicates(set, workers)) {
    set.duplicate = drop_duplicates(seeds, set.input);
    gather(seeds, workers, set);
  }
  return set;
}

void check_weights(std::span<const double> weights, int threads) {
  const std::size_t seed = first_bad(weights, threads);
  if (seed < weights.size()) refuse_seed(seed, weight_fault(weights[seed]));
}

}  // namespace powercell
