// The number of cells of random seeds that the device cannot prove: each costs the host as much as about five
// cost the device. Correct results do not show that a proof became weaker.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>

#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// A diagram of n white seeds in the unit box with its adjacency.
Diagram white_diagram(int dimension, WeightRange range, std::size_t n, Precision precision) {
  Random random(17);
  const SeedArray seeds = random_seeds(Distribution::white, range, n, dimension, random);
  const std::vector<double> low(static_cast<std::size_t>(dimension), 0.0), high(low.size(), 1.0);
  Options options;
  options.precision = precision;
  Diagram diagram(Device::choose(), Domain::box(low, high), options);
  diagram.set_seeds(seeds.view());
  diagram.compute(true, false);
  return diagram;
}

/// The number of pairs that were left to the host beside that of the cells.
double fraction_left(Diagram& diagram) {
  return static_cast<double>(diagram.timings().uncertain) /
         static_cast<double>(diagram.measures().count(SeedStatus::ok));
}

/// The largest error of a measure, relative to it.
double worst_error(const Measures& computed, const Measures& right) {
  double worst = 0;
  for (std::size_t i = 0; i < right.mass.size(); ++i)
    if (right.mass[i] > 0)
      worst = std::max(worst, std::abs(computed.mass[i] - right.mass[i]) / right.mass[i]);
  return worst;
}

void check_float(int dimension, WeightRange range, std::size_t n) {
  CAPTURE(dimension);
  CAPTURE(name(range));
  CAPTURE(n);
  Diagram narrow = white_diagram(dimension, range, n, Precision::float32);
  CHECK(fraction_left(narrow) < 0.015);
  if (!Device::choose().info().fp64) return;
  Diagram wide = white_diagram(dimension, range, n, Precision::float64);
  CHECK(fraction_left(wide) < 1e-3);
  CHECK(narrow.measures().status == wide.measures().status);
  CHECK(narrow.adjacency().offset == wide.adjacency().offset);
  CHECK(narrow.adjacency().neighbor == wide.adjacency().neighbor);
  CHECK(worst_error(narrow.measures(), wide.measures()) < 1e-5);
}

constexpr WeightRange all_ranges[] = {WeightRange::W0, WeightRange::W1, WeightRange::W2};

}  // namespace

TEST_CASE("few cells of random seeds are left to the host, at any number") {
  for (const int dimension : {2, 3}) {
    for (const WeightRange range : all_ranges) check_float(dimension, range, 10000);
    check_float(dimension, WeightRange::W1, number_of_inputs(40000u, 100000u));
  }
}

TEST_CASE("campaign: few cells of a million random seeds are left to the host" * doctest::skip()) {
  for (const int dimension : {2, 3})
    for (const WeightRange range : all_ranges) check_float(dimension, range, 1000000);
}
