#include "bench/paper/list_use.hpp"

#include "kernels/layout.h"
#include "lib/base/threads.hpp"
#include "lib/clip/clipper.hpp"
#include "lib/diagram/setup.hpp"

namespace powercell::paper {

ListUse count_list_use(const Device& device, const Domain& domain, const SeedsView& view,
                       const Options& options) {
  const int threads = thread_count(options.threads);
  const SeedSet seeds = make_seed_set(view, domain.dimension(), threads);
  const PackedTree tree = build_packed_tree(seeds, threads);
  const bool float32 = choose_precision(device, options.precision) == Precision::float32;
  const OwnScene own(device.context(), domain.mesh(), float32, seeds, tree);
  const Pairs pairs = PairFinder(domain.mesh(), threads).by_regions(seeds, tree);
  std::vector<std::uint32_t> pair_seed;
  for (std::uint32_t rank = 0; rank < seeds.size(); ++rank)
    pair_seed.insert(pair_seed.end(), pairs.offset[rank + 1] - pairs.offset[rank], rank);
  ListCandidates lists(own.scene, options);
  lists.count_use();
  Clipper(own.scene, lists, OUTPUT_MOMENTS).clip(pair_seed, pairs.region);
  return lists.use();
}

}  // namespace powercell::paper
