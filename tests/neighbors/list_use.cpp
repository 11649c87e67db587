#ifdef POWERCELL_TEST_FLANN
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/diagram.hpp>

#include "kernels/layout.h"
#include "lib/clip/clipper.hpp"
#include "lib/neighbors/list_candidates.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

ListUse count_use(const Device& device, const Domain& domain, const SeedArray& array,
                  const Options& options) {
  const SeedSet seeds = make_seed_set(array.view(), domain.dimension(), 1);
  const PackedTree tree = build_packed_tree(seeds, 1);
  const OwnScene own(device.context(), domain.mesh(), false, seeds, tree);
  ListCandidates lists(own.scene, options);
  lists.count_use();
  std::vector<std::uint32_t> ranks(seeds.size());
  std::iota(ranks.begin(), ranks.end(), 0U);
  Clipper(own.scene, lists, OUTPUT_MOMENTS).clip(ranks, std::vector<std::uint32_t>(seeds.size(), 0));
  return lists.use();
}

/// The number of neighbours within the security radius of the finished cells (docs/mathematics.md (8)), from
/// the geometry of the cells and all pairs of seeds.
std::uint64_t within_security_radius(Diagram& diagram, const SeedArray& seeds, double eta, bool twins) {
  const Cells& cells = diagram.cells();
  const auto d = static_cast<std::size_t>(seeds.dimension);
  std::uint64_t needed = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double* p = &seeds.positions[i * d];
    double r2 = 0;
    for (std::size_t v = cells.vertex_offset[cells.cell_offset[i]];
         v < cells.vertex_offset[cells.cell_offset[i + 1]]; ++v) {
      double s = 0;
      for (std::size_t k = 0; k < d; ++k) s += std::pow(cells.vertices[v * d + k] - p[k], 2);
      r2 = std::max(r2, s);
    }
    const double hi = std::sqrt(eta - seeds.weights[i]);
    for (std::size_t j = 0; j < seeds.size(); ++j) {
      const double hj = std::sqrt(eta - seeds.weights[j]), h = twins ? hi + hj : hi - hj;
      double s = h * h;
      for (std::size_t k = 0; k < d; ++k) s += std::pow(seeds.positions[j * d + k] - p[k], 2);
      needed += j != i && s < 4 * (r2 + hi * hi) ? 1 : 0;
    }
  }
  return needed;
}

}  // namespace

TEST_CASE("lists: the counts agree with the security radius") {
  INFO(replay_hint());
  const Device& device = main_setups().front().device;
  if (!device.info().fp64) return;
  for (const int d : {2, 3})
    for (const bool twins : {true, false})
      for (const double factor : {1.0, 8.0}) {
        Random random(test_seed());
        const SeedArray seeds = random_seeds(Distribution::blue, WeightRange::W1, 400, d, random);
        Options options;
        options.neighbors = Neighbors::flann;
        options.twin_queries = twins;
        options.lift_eta = factor * *std::max_element(seeds.weights.begin(), seeds.weights.end());
        options.initial_neighbors = 10;
        Diagram diagram(device, unit_box(d), options);
        diagram.set_seeds(seeds.view());
        diagram.compute(true, true);
        REQUIRE(diagram.measures().count(SeedStatus::hidden) == 0);

        const ListUse use = count_use(device, unit_box(d), seeds, options);
        CAPTURE(d);
        CAPTURE(twins);
        CAPTURE(factor);
        CHECK(use.pairs == seeds.size());
        CHECK(use.tried == within_security_radius(diagram, seeds, options.lift_eta, twins));
        CHECK(use.cuts >= diagram.adjacency().neighbor.size());
        CHECK(use.cuts <= use.tried);
        // The next round queries each unfinished pair with a list twice as long.
        REQUIRE(use.pairs_per_round.size() == static_cast<std::size_t>(diagram.timings().rounds));
        std::uint64_t queries = 0, entries = 0, left = use.pairs;
        for (std::size_t round = 0; round < use.pairs_per_round.size(); ++round) {
          queries += left;
          entries += left * std::min<std::uint64_t>(seeds.size() - 1, 10U << round);
          left -= use.pairs_per_round[round];
        }
        CHECK(left == 0);
        CHECK(use.queries == queries);
        CHECK(use.entries == entries);
      }
}
#endif
