#ifdef POWERCELL_TEST_FLANN
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>

#include "tests/support/compare.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Result {
  Measures measures;
  Adjacency adjacency;
};

Result compute(const Domain& domain, const SeedArray& seeds, const Options& options) {
  Diagram diagram(main_setups().front().device, domain, options);
  diagram.set_seeds(seeds.view());
  diagram.compute(true, false);
  return {diagram.measures(), diagram.adjacency()};
}

/// The providers cut cells in different orders, so their results differ by rounding.
void check_same(const Result& lists, const Result& tree, double domain_measure) {
  REQUIRE(lists.measures.status == tree.measures.status);
  REQUIRE(lists.adjacency.offset == tree.adjacency.offset);
  REQUIRE(lists.adjacency.neighbor == tree.adjacency.neighbor);
  for (std::size_t i = 0; i < tree.measures.mass.size(); ++i)
    REQUIRE(std::abs(lists.measures.mass[i] - tree.measures.mass[i]) <= 1e-12 * domain_measure);
}

/// The options that figures 3, 4 and 6 of the paper vary.
std::vector<Options> list_options(const SeedArray& seeds) {
  const double largest = *std::max_element(seeds.weights.begin(), seeds.weights.end());
  std::vector<Options> all;
  for (const double factor : {1.0, 1.5, 30.0, 1e6})
    for (const bool twins : {true, false})
      for (const int initial : {1, 7, 100}) {
        Options options;
        options.neighbors = Neighbors::flann;
        options.lift_eta = factor * largest;
        options.twin_queries = twins;
        options.initial_neighbors = initial;
        all.push_back(options);
      }
  return all;
}

}  // namespace

TEST_CASE("lists: the cells do not depend on the lift, the twin or the first length") {
  INFO(replay_hint());
  if (!main_setups().front().device.info().fp64) return;  // the tolerance is that of double precision
  Random shape(7);
  const std::vector<NamedDomain> domains = {{"box2", unit_box(2)},
                                            {"box3", unit_box(3)},
                                            {"torus", surface_of(torus(12, 7))},
                                            {"tetrahedra", volume_of(cube_tetrahedra(2, 0.15, shape))}};
  for (const NamedDomain& named : domains)
    for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
      Random random(test_seed());
      const SeedArray seeds = seeds_for(named.domain, distribution, WeightRange::W2, 300, random);
      const Result tree = compute(named.domain, seeds, {});
      REQUIRE(tree.measures.count(SeedStatus::hidden) > 0);
      for (const Options& options : list_options(seeds)) {
        CAPTURE(named.name);
        CAPTURE(name(distribution));
        CAPTURE(options.lift_eta);
        CAPTURE(options.twin_queries);
        CAPTURE(options.initial_neighbors);
        check_same(compute(named.domain, seeds, options), tree, named.domain.measure());
      }
    }
}

TEST_CASE("lists: squares of lengths in the caller's unit may overflow or underflow") {
  INFO(replay_hint());
  if (!main_setups().front().device.info().fp64) return;  // single precision refuses such seeds
  for (const double unit : {0x1p-330, 1.0, 0x1p330})
    for (const double extent : {1e-35, 1.0, 1e65}) {  // of the seeds; the domain is [-1, 1]^2
      CAPTURE(unit);
      CAPTURE(extent);
      const std::vector<double> low(2, -unit), high(2, unit);
      const Domain domain = Domain::box(low, high);
      Random random(test_seed());
      SeedArray seeds{2, {}, std::vector<double>(200)};
      for (int k = 0; k < 400; ++k) seeds.positions.push_back(unit * extent * random.uniform(-1, 1));
      Options options;
      options.decisions = Decisions::fast;  // exact ones would repair cells with wrong lists on the host
      Diagram tree(main_setups().front().device, domain, options);
      options.neighbors = Neighbors::flann;
      options.initial_neighbors = 4;
      Diagram lists(main_setups().front().device, domain, options);
      tree.set_seeds(seeds.view());
      lists.set_seeds(seeds.view());
      CHECK(lists.measures().status == tree.measures().status);
      CHECK(lists.measures().total() == doctest::Approx(tree.measures().total()).epsilon(1e-12));
      CHECK(lists.timings().uncertain <= tree.timings().uncertain + 4);
    }
}
#endif
