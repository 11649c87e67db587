#include <doctest/doctest.h>

#include <powercell/verify.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Of the diagram, and of the saved diagram.
void expect_laws(const Setup& setup, const Domain& domain, const SeedsView& seeds) {
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds);
  std::vector<LawCheck> checks = verify(diagram, seeds, {200, test_seed()});
  const JoinedCells joined = join(domain, diagram.cells());
  for (LawCheck& check :
       verify(SavedDiagram{domain.kind(), diagram.precision(), seeds, diagram.measures(), joined},
              {200, test_seed()})) {
    check.law += " (saved)";
    checks.push_back(std::move(check));
  }
  CHECK(checks.size() == 14);
  for (const LawCheck& check : checks) {
    INFO(setup.name << ": " << check.law << ": " << check.value << " of " << check.tolerance << "; "
                    << check.detail);
    CHECK(check.passed);
    CHECK(check.value <= check.tolerance);
    CHECK(check.detail.empty());
  }
}

}  // namespace

TEST_CASE("random diagrams of every kind of domain obey the laws") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const auto& list : {polygon_domains(), surface_domains(), volume_domains(), box_domains()}) {
    for (const NamedDomain& named : list) {
      INFO("domain " << named.name);
      for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
        const SeedArray seeds = seeds_for(named.domain, Distribution::white, range, 150, random);
        for (const Setup& setup : all_setups()) expect_laws(setup, named.domain, seeds.view());
      }
    }
  }
}

TEST_CASE("degenerate seeds obey the laws") {
  Random random(test_seed());
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    for (const int d : {2, 3}) {
      expect_laws(setup, unit_box(d), SeedsView{d, {}, {}});
      expect_laws(setup, unit_box(d), grid(4, d).view());
      expect_laws(setup, unit_box(d), cospherical(20, d).view());
      SeedArray repeated = grid(3, d);
      repeated.positions.insert(repeated.positions.end(), repeated.positions.begin(),
                                repeated.positions.end());
      repeated.weights.resize(repeated.size(), 0.001);
      expect_laws(setup, unit_box(d), repeated.view());
    }
  }
}

TEST_CASE("diagrams all of whose walls are shorter than rounding obey the laws") {
  // Bisectors that cut off the corner (1, 1) or (1, 1, 1) by a few roundings of its distance from the seeds.
  for (const Setup& setup : main_setups())
    for (const int d : {2, 3})
      for (int k = -8; k <= 16; ++k) {
        INFO(setup.name << " in " << d << " dimensions, " << k << " roundings");
        const double part[] = {0.3, 0.7, 0.4}, off = 1 + k * 0x1p-54;
        SeedArray seeds{d, {}, {0, 0}};
        for (int side = 0; side < 2; ++side)
          for (int c = 0; c < d; ++c) seeds.positions.push_back(off + (side == 0 ? -part[c] : part[c]));
        expect_laws(setup, unit_box(d), seeds.view());
      }
}

TEST_CASE("seeds close together, whose bisectors with others are nearly parallel, obey the laws") {
  // Below about 1e-8 decisions are exact, and the geometry is exact up to its last digits.
  for (const Setup& setup : main_setups())
    for (const auto& list : {surface_domains(), volume_domains(), box_domains()})
      for (const NamedDomain& named : list)
        for (const double near : {1e-3, 1e-4, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8, 1e-8, 1e-9}) {
          INFO("domain " << named.name << ", " << near << " apart");
          const auto low = named.domain.low(), high = named.domain.high();
          const double parts[][3] = {
              {0.7, 0.55, 0.8}, {0.52, 0.6, near}, {near, near, near}, {near, 0, 0}, {}};
          SeedArray seeds{named.domain.dimension(), {}, std::vector<double>(5, 0)};
          for (const auto& part : parts)
            for (std::size_t c = 0; c < static_cast<std::size_t>(seeds.dimension); ++c)
              seeds.positions.push_back((low[c] + high[c]) / 2 + part[c] * (high[c] - low[c]) / 2);
          expect_laws(setup, named.domain, seeds.view());
        }
}

TEST_CASE("cells that measure less than the least number of single precision obey the laws") {
  const std::vector<double> low{-13, -13}, high{1e30, 1e30}, seeds{1e-290, 0, -3, -7, 0.5, 5};
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    expect_laws(setup, Domain::box(low, high), {2, seeds, {}});
  }
}

TEST_CASE("seeds other than the diagram's are refused or break laws") {
  Random random(test_seed());
  const SeedArray seeds = scatter(Distribution::white, 50, 2, {}, random);
  const SeedArray others = scatter(Distribution::white, 50, 2, {}, random);
  const Setup& setup = main_setups().front();
  Diagram diagram(setup.device, unit_box(2), setup.options);
  diagram.set_seeds(seeds.view());
  CHECK_THROWS_AS(verify(diagram, scatter(Distribution::white, 49, 2, {}, random).view()), Error);
  CHECK_THROWS_AS(verify(diagram, scatter(Distribution::white, 50, 3, {}, random).view()), Error);
  // Too few weights, and half a seed too much.
  const std::vector<double> weights(49, 0);
  CHECK_THROWS_AS(verify(diagram, {2, seeds.positions, weights}), Error);
  std::vector<double> positions = seeds.positions;
  positions.push_back(0.5);
  CHECK_THROWS_AS(verify(diagram, {2, positions, {}}), Error);
  std::size_t failed = 0;
  for (const LawCheck& check : verify(diagram, others.view())) {
    failed += !check.passed;
    CHECK(check.detail.empty() == check.passed);
  }
  CHECK(failed > 0);
}
