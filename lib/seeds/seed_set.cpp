#include "lib/seeds/seed_set.hpp"

#include <algorithm>

#include "lib/seeds/duplicates.hpp"
#include "lib/seeds/hilbert.hpp"
#include "lib/seeds/threads.hpp"
#include "lib/seeds/validate.hpp"

namespace powercell {

SeedSet make_seed_set(const SeedsView& seeds, int dimension, int threads) {
  const int workers = thread_count(threads);
  validate_seeds(seeds, dimension, workers);

  SeedSet set;
  set.dimension = dimension;
  set.input_count = seeds.size();
  set.input = hilbert_order(seeds.positions, dimension, workers);
  set.duplicate = drop_duplicates(seeds, set.input);

  const std::size_t d = static_cast<std::size_t>(dimension);
  set.positions.resize(set.size() * d);
  set.weights.resize(set.size());
  parallel_for(workers, set.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t rank = begin; rank < end; ++rank) {
      const std::size_t i = set.input[rank];
      std::copy_n(&seeds.positions[i * d], d, &set.positions[rank * d]);
      set.weights[rank] = seeds.weights.empty() ? 0.0 : seeds.weights[i];
    }
  });
  return set;
}

}  // namespace powercell
