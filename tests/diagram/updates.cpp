// The state that a diagram keeps between calls must not affect its results.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "tests/diagram/check.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Same bits, NaN included.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

void check_same(Diagram& a, Diagram& b) {
  CHECK(same(a.measures().mass, b.measures().mass));
  CHECK(same(a.measures().centroid, b.measures().centroid));
  CHECK(same(a.measures().second_moment, b.measures().second_moment));
  CHECK(a.measures().status == b.measures().status);
  CHECK(a.adjacency().offset == b.adjacency().offset);
  CHECK(a.adjacency().neighbor == b.adjacency().neighbor);
  CHECK(same(a.adjacency().wall, b.adjacency().wall));
  CHECK(same(a.cells().vertices, b.cells().vertices));
  CHECK(a.cells().border == b.cells().border);
  CHECK(a.dual().simplices == b.dual().simplices);
}

std::vector<NamedDomain> a_domain_of_each_kind() {
  return {{"islands", Domain::polygon(islands())},
          {"torus", surface_of(torus(12, 7))},
          {"ball", volume_of(ball_tetrahedra(0))},
          {"box3", unit_box(3)}};
}

template <class Body>
void for_each_domain_and_setup(Body body) {
  INFO(replay_hint());
  for (const NamedDomain& named : a_domain_of_each_kind())
    for (const Setup& setup : all_setups()) {
      INFO(named.name << ", " << setup.name);
      Random random(test_seed());
      body(named.domain, setup, seeds_for(named.domain, Distribution::white, WeightRange::W1, 300, random),
           random);
    }
}

}  // namespace

TEST_CASE("new weights give the same diagram as new seeds") {
  for_each_domain_and_setup([](const Domain& domain, const Setup& setup, SeedArray seeds, Random& random) {
    Diagram kept(setup.device, domain, setup.options);
    kept.set_seeds(seeds.view());
    kept.measures();
    kept.cells();
    const double h = spacing(domain.measure(), seeds.size(), domain.cell_dimension());
    // Weights that hide many seeds, none, and few.
    for (const WeightRange range : {WeightRange::W2, WeightRange::W0, WeightRange::W1}) {
      set_weights(seeds, range, h, random);
      kept.set_weights(seeds.weights);
      Diagram fresh(setup.device, domain, setup.options);
      fresh.set_seeds(seeds.view());
      check_same(kept, fresh);
    }
  });
}

TEST_CASE("new weights decide which of two seeds at one position is the duplicate") {
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    SeedArray seeds{2, {0.2, 0.2, 0.7, 0.7, 0.7, 0.7}, {0, 0.1, 0}};
    Diagram diagram(setup.device, unit_box(2), setup.options);
    diagram.set_seeds(seeds.view());
    CHECK(diagram.measures().status[1] == SeedStatus::ok);
    CHECK(diagram.measures().status[2] == SeedStatus::duplicate);
    diagram.set_weights(std::vector<double>{0, 0.1, 0.2});
    CHECK(diagram.measures().status[1] == SeedStatus::duplicate);
    CHECK(diagram.measures().status[2] == SeedStatus::ok);
  }
}

TEST_CASE("results do not depend on the order of calls") {
  for_each_domain_and_setup([](const Domain& domain, const Setup& setup, const SeedArray& seeds, Random&) {
    Diagram forwards(setup.device, domain, setup.options), backwards(setup.device, domain, setup.options);
    forwards.set_seeds(seeds.view());
    backwards.set_seeds(seeds.view());
    backwards.dual();
    backwards.cells();
    backwards.adjacency();
    check_same(forwards, backwards);
  });
}

TEST_CASE("measure() gives the measures of a diagram") {
  for_each_domain_and_setup([](const Domain& domain, const Setup& setup, const SeedArray& seeds, Random&) {
    Diagram diagram(setup.device, domain, setup.options);
    diagram.set_seeds(seeds.view());
    CHECK(same(measure(setup.device, domain, seeds.view(), setup.options).mass, diagram.measures().mass));
  });
}

TEST_CASE("a diagram can be used after an error") {
  for_each_domain_and_setup([](const Domain& domain, const Setup& setup, SeedArray seeds, Random&) {
    Diagram diagram(setup.device, domain, setup.options), fresh(setup.device, domain, setup.options);
    diagram.set_seeds(seeds.view());
    fresh.set_seeds(seeds.view());
    std::vector<double> bad = seeds.weights;
    bad[17] = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(diagram.set_weights(bad), Error);
    CHECK(diagram.size() == seeds.size());
    SeedArray bad_seeds = seeds;
    bad_seeds.positions[3] = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(diagram.set_seeds(bad_seeds.view()), Error);
    CHECK(diagram.size() == seeds.size());
    check_same(diagram, fresh);
  });
}

TEST_CASE("an interrupted diagram can be computed later") {
  for_each_domain_and_setup([](const Domain& domain, const Setup& setup, const SeedArray& seeds, Random&) {
    bool go_on = false;
    double last = 0;
    Options options = setup.options;
    options.progress = [&](double fraction) {
      CHECK(fraction >= 0);
      CHECK(fraction <= 1);
      last = fraction;
      return go_on;
    };
    Diagram diagram(setup.device, domain, options), fresh(setup.device, domain, setup.options);
    diagram.set_seeds(seeds.view());
    fresh.set_seeds(seeds.view());
    try {
      diagram.measures();
      FAIL("the computation was not stopped");
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::interrupted);
    }
    go_on = true;
    check_same(diagram, fresh);
    CHECK(last > 0);
  });
}

TEST_CASE("the progress of a computation never falls, whatever its passes, and ends at 1") {
  for_each_domain_and_setup([](const Domain& domain, const Setup& setup, const SeedArray& seeds, Random&) {
    std::vector<double> reports;
    Options options = setup.options;
    options.chunk_pairs = 1024;
    options.progress = [&](double fraction) {
      reports.push_back(fraction);
      return true;
    };
    Diagram diagram(setup.device, domain, options);
    diagram.set_seeds(seeds.view());
    diagram.compute(true, true);
    REQUIRE_FALSE(reports.empty());
    CHECK(std::is_sorted(reports.begin(), reports.end()));
    CHECK(reports.back() == 1);
    reports.clear();
    diagram.set_weights(seeds.weights);  // begins again
    diagram.measures();
    CHECK(std::is_sorted(reports.begin(), reports.end()));
    CHECK(reports.back() == 1);
  });
}
