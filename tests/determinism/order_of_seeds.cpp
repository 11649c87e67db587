// Permuting the seeds permutes the results and changes no bit of them.
#include <doctest/doctest.h>

#include "tests/support/domains.hpp"
#include "tests/support/permuted.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Results results(const Setup& setup, const Domain& domain, const SeedArray& seeds) {
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds.view());
  return results_of(diagram);
}

/// The seed that is kept at the position of seed k: the heaviest, else the first.
std::size_t heaviest_at(const SeedArray& seeds, std::size_t k) {
  std::size_t stays = k;
  for (std::size_t j = 0; j < seeds.size(); ++j) {
    bool same = true;
    for (int c = 0; c < seeds.dimension; ++c) same &= seeds.coordinate(j, c) == seeds.coordinate(k, c);
    if (same &&
        (seeds.weights[j] > seeds.weights[stays] || (seeds.weights[j] == seeds.weights[stays] && j < stays)))
      stays = j;
  }
  return stays;
}

/// Compares the results for `seeds` to those for two other orders.
void check_orders(const NamedDomain& named, const SeedArray& seeds, Random& random,
                  const std::vector<Setup>& setups, bool with_dual = true) {
  Permutation backwards;
  for (std::size_t k = seeds.size(); k-- > 0;) backwards.push_back(static_cast<std::uint32_t>(k));
  for (const Setup& setup : setups) {
    INFO(named.name << ", " << setup.name);
    const Results expected = results(setup, named.domain, seeds);
    for (const Permutation& from : {backwards, random_permutation(seeds.size(), random)}) {
      const Results other = restored(results(setup, named.domain, permuted(seeds, from)), from);
      CHECK(bit_differences(other.measures, expected.measures) == "");
      CHECK(bit_differences(other.adjacency, expected.adjacency) == "");
      CHECK(bit_differences(other.cells, expected.cells) == "");
      if (with_dual) CHECK(bit_differences(other.dual, expected.dual) == "");
    }
  }
}

}  // namespace

TEST_CASE("permuted seeds give permuted measures, adjacency, cells and dual, bit for bit") {
  INFO(replay_hint());
  for (const NamedDomain& named : one_of_each())
    for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
      INFO(name(distribution));
      Random random(test_seed());
      check_orders(named, seeds_for(named.domain, distribution, WeightRange::W2, 300, random), random,
                   all_setups());
    }
}

TEST_CASE("permuted grids, where every decision is a tie") {
  INFO(replay_hint());
  for (const NamedDomain& named : one_of_each()) {
    Random random(test_seed());
    const int d = named.domain.dimension();
    for (const double angle : {0.0, 0.7}) {
      INFO("turned by " << angle);
      SeedArray seeds = grid(d == 2 ? 9 : 5, d, Box{named.domain.low(), named.domain.high()});
      rotate(seeds, angle, {0.5, 0.5, 0.5});
      // On a surface three cells may meet in several points, in different orders around them. Which of these
      // orients their simplex depends on the order of the seeds.
      check_orders(named, seeds, random, main_setups(), d == named.domain.cell_dimension());
    }
    check_orders(named, cospherical(40, d, Box{named.domain.low(), named.domain.high()}), random,
                 main_setups());
  }
}

TEST_CASE("permuted seeds closer together than the grid of the curve") {
  INFO(replay_hint());
  for (const NamedDomain& named : one_of_each()) {
    Random random(test_seed());
    const SeedArray seeds = spread_over_scales(200, named.domain.dimension(), 6, random,
                                               Box{named.domain.low(), named.domain.high()});
    check_orders(named, seeds, random, main_setups());
  }
}

TEST_CASE("of duplicates the heaviest is kept in any order, else the first of that order") {
  INFO(replay_hint());
  for (const NamedDomain& named : one_of_each()) {
    Random random(test_seed());
    SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, 120, random);
    for (std::size_t i = 0; i < 60; ++i) {  // ten seeds at each of six positions
      for (int k = 0; k < seeds.dimension; ++k) seeds.coordinate(i, k) = seeds.coordinate(60 + i % 6, k);
      if (i % 6 < 3) seeds.weights[i] = seeds.weights[60 + i % 6];  // of equal weights
    }
    for (const Setup& setup : main_setups()) {
      INFO(named.name << ", " << setup.name);
      const Measures first = results(setup, named.domain, seeds).measures;
      const Permutation from = random_permutation(seeds.size(), random);
      const SeedArray moved = permuted(seeds, from);
      const Measures second = results(setup, named.domain, moved).measures;
      std::size_t stayed = 0;
      for (std::size_t k = 0; k < moved.size(); ++k) {
        const std::size_t stays = heaviest_at(moved, k);
        CHECK((second.status[k] == SeedStatus::duplicate) == (stays != k));
        if (stays != k) continue;
        ++stayed;
        const std::size_t i = heaviest_at(seeds, from[k]);  // same position and weight, maybe another seed
        CHECK(first.status[i] == second.status[k]);
        CHECK(first.mass[i] == second.mass[k]);
        CHECK(first.second_moment[i] == second.second_moment[k]);
      }
      CHECK(stayed == 60);
    }
  }
}
