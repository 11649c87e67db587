// The laws in periodic domains: of boxes periodic along some axes, lattices, few seeds and seeds far outside.
#include <doctest/doctest.h>

#include <powercell/error.hpp>
#include <powercell/verify.hpp>

#include "lib/verify/laws.hpp"
#include "lib/verify/unfold.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::vector<NamedDomain> domains_of_laws() {
  const std::array<bool, 3> along_xz{true, false, true};
  const std::array<double, 3> low{0, 0, 0}, high{1, 1, 1};
  return {{"square", Domain::periodic_box(std::span(low).first(2), std::span(high).first(2))},
          {"flat", Domain::periodic_box(std::array{0.0, 0.0}, std::array{1.0, 0.05})},
          {"cube", Domain::periodic_box(low, high)},
          {"slab", Domain::periodic_box(low, high, along_xz)},
          {"lattice2", Domain::lattice(std::array{1.0, 0.0, 2.7, 0.8})},
          {"lattice3", Domain::lattice(std::array{1.0, 0.0, 0.0, 0.4, 1.1, 0.0, -0.3, 0.2, 0.9})}};
}

void expect_periodic_laws(const Setup& setup, const Domain& domain, const SeedsView& seeds) {
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds);
  const std::vector<LawCheck> checks = verify(diagram, seeds, {200, test_seed()});
  CHECK(checks.size() == 7);
  for (const LawCheck& check : checks) {
    INFO(setup.name << ", " << seeds.size() << " seeds: " << check.law << ": " << check.value << " of "
                    << check.tolerance << "; " << check.detail);
    CHECK(check.passed);
  }
}

}  // namespace

TEST_CASE("periodic diagrams obey the laws") {
  INFO(replay_hint());
  for (const NamedDomain& named : domains_of_laws()) {
    INFO(named.name);
    for (const Setup& setup : all_setups()) {
      Random random(test_seed());
      for (const std::size_t n : {1, 2, 7, 150})
        for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
          SeedArray seeds = seeds_for(named.domain, Distribution::white, range, n, random);
          expect_periodic_laws(setup, named.domain, seeds.view());
          if (named.domain.periods()[0][0] == 0) continue;
          for (std::size_t i = 0; i < n; i += 2)
            seeds.coordinate(i, 0) += 3;  // three periods of these domains
          expect_periodic_laws(setup, named.domain, seeds.view());
        }
    }
  }
}

TEST_CASE("in periodic diagrams each law finds its fault") {
  for (const NamedDomain& named : domains_of_laws()) {
    INFO(named.name);
    Setup setup = main_setups().front();
    Random random(test_seed());
    SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, 60, random);
    Diagram diagram(setup.device, named.domain, setup.options);
    diagram.set_seeds(seeds.view());
    const auto fails = [&](const SeedsView& view, std::size_t law) {
      const std::vector<LawCheck> checks = verify(diagram, view, {300, 1});
      return !checks[law].passed;
    };
    CHECK_FALSE(fails(seeds.view(), 5));
    CHECK_FALSE(fails(seeds.view(), 6));
    const double h = spacing(named.domain.measure(), 60, named.domain.cell_dimension());
    seeds.weights[5] += 4 * h * h;
    CHECK(fails(seeds.view(), 5));  // walls off their bisectors
    CHECK(fails(seeds.view(), 6));  // points in cells of others

    Adjacency adjacency = diagram.adjacency();
    const Rounding rounding(extent_of(named.domain), seeds.view(), diagram.precision());
    CHECK(check_walls(adjacency, &named.domain.mesh(), rounding).passed);
    for (auto& shift : adjacency.shift)
      if (shift != std::array<std::int32_t, 3>{}) {
        shift[0] += 5;
        break;
      }
    CHECK_FALSE(check_walls(adjacency, &named.domain.mesh(), rounding).passed);
  }
}

TEST_CASE("saved diagrams of periodic domains are refused, as their periods are not known") {
  const Setup setup = main_setups().front();
  Random random(test_seed());
  const Domain square = Domain::periodic_box(std::array{0.0, 0.0}, std::array{1.0, 1.0});
  const SeedArray seeds = seeds_for(square, Distribution::white, WeightRange::W0, 20, random);
  Diagram diagram(setup.device, square, setup.options);
  diagram.set_seeds(seeds.view());
  const SavedDiagram saved{square.kind(), diagram.precision(), seeds.view(), diagram.measures(),
                           diagram.joined()};
  try {
    verify(saved);
    FAIL("checked without periods");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::unsupported);
  }
}
