// The dual against CGAL's periodic triangulations.
#include <doctest/doctest.h>

#include <algorithm>
#include <powercell/diagram.hpp>
#include <set>

#include "tests/periodic/images_of_simplices.hpp"
#include "tests/support/cgal_periodic.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Simplex = PeriodicSimplex;

std::set<Simplex> simplices_of(const Dual& dual) {
  std::set<Simplex> all;
  const auto corners = static_cast<std::size_t>(dual.corners);
  for (std::size_t row = 0; row < dual.size(); ++row) {
    Simplex simplex;
    for (std::size_t k = row * corners; k < (row + 1) * corners; ++k)
      simplex.push_back({dual.simplices[k], dual.shift[k]});
    all.insert(first_image(simplex));
  }
  CHECK(all.size() == dual.size());
  return all;
}

void check(int dimension, Distribution distribution, std::size_t n, double largest_weight) {
  INFO(dimension << " dimensions, " << name(distribution) << ", " << n << " seeds, weights to "
                 << largest_weight);
  Random random(test_seed());
  SeedArray seeds = scatter(distribution, n, dimension, {}, random);
  for (double& w : seeds.weights) w = random.uniform(0, largest_weight);
  std::set<Simplex> expected;
  for (const Simplex& simplex : cgal_periodic_simplices(seeds)) expected.insert(first_image(simplex));
  REQUIRE(!expected.empty());
  const std::array<double, 3> low{0, 0, 0}, high{1, 1, 1};
  const auto d = static_cast<std::size_t>(dimension);
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    Diagram diagram(setup.device, Domain::periodic_box(std::span(low).first(d), std::span(high).first(d)),
                    setup.options);
    diagram.set_seeds(seeds.view());
    CHECK(simplices_of(diagram.dual()) == expected);
  }
}

}  // namespace

TEST_CASE("periodic duals are CGAL's: the square") {
  INFO(replay_hint());
  for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
    for (const std::size_t n : {20, 300, 1000}) check(2, distribution, n, 0);
}

TEST_CASE("periodic duals are CGAL's: the cube, without weights and with some that hide seeds") {
  INFO(replay_hint());
  for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
    for (const std::size_t n : {20, 500})
      for (const double weight : {0.0, 1e-3, 0.0156})
        if (n == 20 || distribution == Distribution::white || all_inputs()) check(3, distribution, n, weight);
}
