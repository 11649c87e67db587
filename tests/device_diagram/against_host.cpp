#include <doctest/doctest.h>

#include <cmath>
#include <powercell/diagram.hpp>

#include "tests/device_diagram/caller.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Compares all results to those of Diagram for the same seeds.
void check_against_host(Caller& caller, DeviceDiagram& diagram, const SeedArray& exact) {
  const Precision precision = diagram.precision();
  const SeedArray seeds = rounded_seeds(exact, precision);
  Options options;
  options.precision = precision;
  const Measures expected = measure(caller.device(), diagram.domain(), seeds.view(), options);
  const Output found = run(caller, diagram, seeds.view());

  const double mean = diagram.domain().measure() / static_cast<double>(seeds.size());
  const double mass_tolerance = tolerance(precision) * mean, length_tolerance = tolerance(precision);
  const auto d = static_cast<std::size_t>(seeds.dimension);
  std::size_t wrong_status = 0, wrong_mass = 0, wrong_centroid = 0, wrong_moment = 0, unfinished = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (found.status[i] == DeviceSeedStatus::unfinished) {
      ++unfinished;
      CHECK(std::isnan(found.mass[i]));
      continue;
    }
    // A cell thinner than rounding may be found or not.
    const bool tiny = expected.mass[i] < mass_tolerance;
    wrong_status += !tiny && static_cast<int>(found.status[i]) != static_cast<int>(expected.status[i]);
    wrong_mass += !(std::abs(found.mass[i] - expected.mass[i]) <= mass_tolerance);
    wrong_moment += !(std::abs(found.second_moment[i] - expected.second_moment[i]) <=
                      tolerance(precision) * (mean + expected.second_moment[i]));
    for (std::size_t k = 0; k < d; ++k) {
      const double a = found.centroid[i * d + k], b = expected.centroid[i * d + k];
      wrong_centroid += found.status[i] == DeviceSeedStatus::ok
                            ? !tiny && !(std::abs(a - b) <= length_tolerance)
                            : !std::isnan(a);
    }
  }
  CHECK(wrong_status == 0);
  CHECK(wrong_mass == 0);
  CHECK(wrong_centroid == 0);
  CHECK(wrong_moment == 0);
  // Only in single precision cells may be unfinished, and few.
  CHECK(unfinished <= (precision == Precision::float64 ? 0 : seeds.size() / 1000));
  if (unfinished == 0)
    CHECK(std::abs(found.total() - diagram.domain().measure()) <=
          tolerance(precision) * diagram.domain().measure());
}

}  // namespace

TEST_CASE("measures from device memory equal those of Diagram") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3}) {
      Options options;
      options.precision = precision;
      DeviceDiagram diagram(caller.device(), unit_box(dimension), options);
      REQUIRE(diagram.precision() == precision);
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
          CAPTURE(dimension);
          CAPTURE(name(weights));
          CAPTURE(name(distribution));
          CAPTURE(static_cast<int>(precision));
          check_against_host(caller, diagram, random_seeds(distribution, weights, 3000, dimension, random));
        }
    }
}

TEST_CASE("measures in domains of several regions equal those of Diagram") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const auto& family : {polygon_domains(), surface_domains(), volume_domains(), box_domains()})
      for (const NamedDomain& domain : family) {
        Options options;
        options.precision = precision;
        DeviceDiagram diagram(caller.device(), domain.domain, options);
        for (const WeightRange weights : {WeightRange::W0, WeightRange::W2})
          for (const std::size_t n : {3u, number_of_inputs(200u, 500u)}) {
            CAPTURE(domain.name);
            CAPTURE(n);
            CAPTURE(name(weights));
            CAPTURE(static_cast<int>(precision));
            check_against_host(caller, diagram,
                               seeds_for(domain.domain, Distribution::white, weights, n, random));
          }
      }
}
