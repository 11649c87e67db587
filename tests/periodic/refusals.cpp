// Bad input of periodic domains, and updates of their diagrams.
#include <doctest/doctest.h>

#include <limits>

#include "tests/periodic/brute_force.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::string refusal_of_lattice(std::vector<double> vectors, std::vector<double> origin = {}) {
  try {
    Domain::lattice(vectors, origin);
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_domain);
    return error.what();
  }
  return {};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("lattices that are none are refused") {
  const double inf = std::numeric_limits<double>::infinity();
  CHECK(has(refusal_of_lattice({1, 0, 2, 0}), "dependent"));
  CHECK(has(refusal_of_lattice({1, 0, 0, 0}), "dependent"));
  CHECK(has(refusal_of_lattice({1, 2, 3, 4, 5, 6, 7, 8, 9}), "dependent"));
  CHECK(has(refusal_of_lattice({1, 0, 0, 0, 1, 0, 0, 0, 1e-7}), "10^6"));
  CHECK(has(refusal_of_lattice({1, 0, 1, 1e-7}), "10^6"));
  CHECK(has(refusal_of_lattice({1, 0, inf, 1}), "finite"));
  CHECK(has(refusal_of_lattice({1, 0, 0}), "coordinates"));
  CHECK(has(refusal_of_lattice({1, 0, 0, 1}, {0, 0, 0}), "coordinates"));
  CHECK(has(refusal_of_lattice({1e-308, 0, 0, 1e-308}), "outside 1e-100"));
  CHECK(has(refusal_of_lattice({1e160, 0, 0, 1e160}), "outside 1e-100"));
  // Rounded as coordinates near the origin are, the vectors would be dependent, 0, or others.
  CHECK(has(refusal_of_lattice({1, 1, 1, -1}, {1e300, 0}), "nearer to the origin"));
  CHECK(has(refusal_of_lattice({1, 0, 0, 1}, {0, -1e20}), "nearer to the origin"));
  CHECK(has(refusal_of_lattice({1, 0, 0.3, 1}, {1e14, 0}), "nearer to the origin"));
  CHECK(refusal_of_lattice({1, 0, 0.3, 1}, {1e11, 0}).empty());
  CHECK(refusal_of_lattice({1, 0, 5e5, 1}).empty());  // skew, not thin
  CHECK(Domain::lattice(std::vector<double>{1, 0, 5e5, 1}).measure() == doctest::Approx(1));
}

TEST_CASE("periodic boxes without periods or too thin are refused") {
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1e-7};
  const bool none[] = {false, false, false}, flat[] = {true, true, false}, two[] = {true, true};
  CHECK_THROWS_AS(Domain::periodic_box(low, high, none), Error);
  CHECK_THROWS_AS(Domain::periodic_box(low, high), Error);
  CHECK_THROWS_AS(Domain::periodic_box(low, high, two), Error);
  CHECK(Domain::periodic_box(low, high, flat).is_periodic());
  const double far[] = {1e15, 0}, beside[] = {1e15 + 0.375, 1}, also[] = {1e11, 0},
               there[] = {1e11 + 0.375, 1};
  CHECK_THROWS_WITH_AS(Domain::periodic_box(far, beside), doctest::Contains("nearer to the origin"), Error);
  CHECK(Domain::periodic_box(also, there).is_periodic());
}

TEST_CASE("periodic diagrams refuse seeds that are too far") {
  const Setup& setup = main_setups().front();
  const double low[] = {0, 0}, high[] = {1, 1};
  const Domain domain = Domain::periodic_box(low, high);
  Diagram diagram(setup.device, domain, setup.options);
  const std::vector<double> far{0.5, 0.5, 1e9, 0.5}, good{0.5, 0.5, -1e6 - 0.25, 0.5};
  CHECK_THROWS_AS(diagram.set_seeds({2, far, {}}), Error);
  diagram.set_seeds({2, good, {}});
  CHECK(diagram.measures().total() == doctest::Approx(1));
  CHECK(diagram.measures().centroid[2] == doctest::Approx(-1e6 - 0.25));
}

TEST_CASE("no seeds in a periodic box") {
  const Setup& setup = main_setups().front();
  const double low[] = {0, 0}, high[] = {1, 1};
  Diagram diagram(setup.device, Domain::periodic_box(low, high), setup.options);
  diagram.set_seeds({2, {}, {}});
  diagram.compute(true, true);
  CHECK(diagram.measures().mass.empty());
  CHECK(diagram.adjacency().offset.size() == 1);
}

TEST_CASE("new weights give the bits of a new diagram") {
  INFO(replay_hint());
  Random random(test_seed());
  const double low[] = {0, 0, 0}, high[] = {1, 1, 1};
  for (const Setup& setup : main_setups()) {
    const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W2, 400, 3, random);
    SeedArray lighter = seeds;
    for (double& w : lighter.weights) w *= 0.25;
    Diagram kept(setup.device, Domain::periodic_box(low, high), setup.options);
    kept.set_seeds(seeds.view());
    kept.compute(true, true);
    kept.set_weights(lighter.weights);
    Diagram fresh(setup.device, Domain::periodic_box(low, high), setup.options);
    fresh.set_seeds(lighter.view());
    kept.compute(true, true);
    fresh.compute(true, true);
    CHECK(bit_differences(kept.measures(), fresh.measures()) == "");
    CHECK(bit_differences(kept.adjacency(), fresh.adjacency()) == "");
    CHECK(bit_differences(kept.cells(), fresh.cells()) == "");
    CHECK(kept.adjacency().shift == fresh.adjacency().shift);
    CHECK(kept.cells().shift == fresh.cells().shift);
    CHECK(kept.positions() == lighter.positions);
  }
}
