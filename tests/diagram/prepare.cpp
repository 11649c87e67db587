// Kernels that are built before they are needed.
#include <doctest/doctest.h>

#include <algorithm>
#include <powercell/diagram.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("after prepare() nothing is compiled") {
  for (const Setup& setup : main_setups()) {
    CAPTURE(setup.name);
    Options options = setup.options;
    std::vector<double> fractions;
    options.progress = [&](double fraction) {
      fractions.push_back(fraction);
      return true;
    };
    for (const int d : {2, 3}) {
      prepare(setup.device, unit_box(d), options);
      const double before = setup.device.build_seconds();
      for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
        Random random(5);
        const SeedArray seeds = random_seeds(Distribution::white, range, 7000, d, random);
        Diagram diagram(setup.device, unit_box(d), setup.options);
        diagram.set_seeds(seeds.view());
        diagram.compute(true, true);
      }
      CHECK(setup.device.build_seconds() == before);
    }
    CHECK(std::is_sorted(fractions.begin(),
                         fractions.begin() + static_cast<std::ptrdiff_t>(fractions.size() / 2)));
    CHECK(fractions.back() == doctest::Approx(1));
  }
}

TEST_CASE("devices opened twice share what is built") {
  const Device first = Device::choose(), second = Device::choose();
  prepare(first, unit_box(2));
  prepare(second, unit_box(2));
  CHECK(second.build_seconds() == 0);
}

TEST_CASE("prepare() can be stopped, and refuses what a diagram refuses") {
  Options options;
  options.progress = [](double) { return false; };
  CHECK_THROWS_AS(prepare(test_device(), unit_box(2), options), Error);
}
