// Eight lanes at once, as on CPUs, and one after the other, as on GPUs, give the same bits.
#include <doctest/doctest.h>

#include "tests/support/domains.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/permuted.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Results results(const char* lanes, const Setup& setup, const Domain& domain, const SeedArray& seeds) {
  const Environment environment("POWERCELL_LANES", lanes);
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds.view());
  return results_of(diagram);
}

}  // namespace

TEST_CASE(
    "lanes eight or four at once and one by one give the same bits, for equal, moderate and hiding weights") {
  for (const NamedDomain& named : one_of_each()) {
    // Polygons and polyhedra differ; other domains have the same cells, compiled anew.
    if (named.name != "square" && named.name != "cube" && !all_inputs()) continue;
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
      Random random(test_seed());
      const SeedArray seeds = seeds_for(named.domain, Distribution::white, range, 1500, random);
      for (const Setup& setup : all_setups()) {
        // Kernels that take lists have the same cells, and take long to compile: one kind of domain is
        // enough.
        if (setup.options.neighbors == Neighbors::flann && (named.name != "cube" || !all_inputs())) continue;
        INFO(named.name << ", " << setup.name << ", W" << static_cast<int>(range));
        const Results eight = results("8", setup, named.domain, seeds);
        if (all_inputs()) CHECK(bit_differences(results("4", setup, named.domain, seeds), eight) == "");
        CHECK(bit_differences(results("1", setup, named.domain, seeds), eight) == "");
      }
    }
  }
}
