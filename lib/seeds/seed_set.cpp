#include "lib/seeds/seed_set.hpp"

#include <algorithm>

#include "lib/base/memory.hpp"
#include "lib/base/threads.hpp"
#include "lib/seeds/duplicates.hpp"
#include "lib/seeds/hilbert.hpp"
#include "lib/seeds/validate.hpp"

namespace powercell {
namespace {

/// Positions and weights in the order of `set.input`.
void gather(const SeedsView& seeds, int threads, SeedSet& set) {
  const auto d = static_cast<std::size_t>(set.dimension);
  resize_populated(set.positions, set.size() * d, threads);
  resize_populated(set.weights, set.size(), threads);
  parallel_for(threads_for(set.size(), threads), set.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t rank = begin; rank < end; ++rank) {
      const std::size_t i = set.input[rank];
      std::copy_n(&seeds.positions[i * d], d, &set.positions[rank * d]);
      set.weights[rank] = seeds.weights.empty() ? 0.0 : seeds.weights[i];
    }
  });
}

/// Whether seeds that follow each other have the same position.
bool has_duplicates(const SeedSet& set, int threads) {
  if (set.size() < 2) return false;
  const auto d = static_cast<std::size_t>(set.dimension);
  const auto as_next = [&](std::size_t rank) {
    const double* const p = &set.positions[rank * d];
    return std::equal(p, p + d, p + d);
  };
  return first_of(set.size() - 1, threads, as_next) < set.size() - 1;
}

}  // namespace

SeedSet make_seed_set(const SeedsView& seeds, int dimension, int threads) {
  const int workers = thread_count(threads);
  validate_seeds(seeds, dimension, workers);

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

}  // namespace powercell
