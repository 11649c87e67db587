// Periodic domains in device memory: boxes and lattices against an exact Diagram.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/device_diagram/repaired.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// n seeds around the domain, some of them several periods outside.
SeedArray seeds_around(const Domain& domain, WeightRange weights, std::size_t n, Random& random) {
  SeedArray seeds = seeds_for(domain, Distribution::white, weights, n, random);
  const auto periods = domain.periods();
  for (std::size_t i = 0; i < n; i += 2)
    for (const auto& period : periods) {
      const double times = static_cast<double>(random.index(9)) - 4;
      for (int c = 0; c < seeds.dimension; ++c)
        seeds.coordinate(i, c) += times * period[static_cast<std::size_t>(c)];
    }
  return seeds;
}

Domain torus_box(int dimension) {
  const std::vector<double> low(static_cast<std::size_t>(dimension), 0.0), high(low.size(), 1.0);
  return Domain::periodic_box(low, high);
}

}  // namespace

TEST_CASE("after repair, everything in periodic domains is that of an exact Diagram") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    std::size_t computed = 0, all = 0;
    for (const NamedDomain& domain : periodic_domains()) {
      DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const std::size_t n : {1u, 2u, 3u, 12u, 300u}) {
          CAPTURE(domain.name);
          CAPTURE(n);
          CAPTURE(name(weights));
          CAPTURE(static_cast<int>(precision));
          computed += check_repaired(caller, diagram, seeds_around(domain.domain, weights, n, random));
          all += n;
        }
    }
    MESSAGE("precision ", static_cast<int>(precision), ": ", computed, " of ", all, " cells");
    CHECK(computed < all / 4);
  }
}

TEST_CASE("few cells of random seeds reach beyond the images") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3})
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2}) {
        CAPTURE(static_cast<int>(precision));
        CAPTURE(dimension);
        CAPTURE(name(weights));
        DeviceDiagram diagram(caller.device(), torus_box(dimension), in_precision(precision));
        const SeedArray seeds =
            rounded_seeds(random_seeds(Distribution::white, weights, 5000, dimension, random), precision);
        const Output output = run(caller, diagram, seeds.view());
        MESSAGE(dimension, "D, ", name(weights), ": ", output.count(DeviceSeedStatus::unfinished));
        CHECK(output.count(DeviceSeedStatus::unfinished) <= 25);
        if (output.count(DeviceSeedStatus::unfinished) == 0)
          CHECK(output.total() == doctest::Approx(1).epsilon(tolerance(precision)));
      }
}

TEST_CASE("periodic seeds that tie, on the borders too") {
  Caller& caller = shared_caller();
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3}) {
      CAPTURE(dimension);
      CAPTURE(static_cast<int>(precision));
      DeviceDiagram diagram(caller.device(), torus_box(dimension), in_precision(precision));
      SeedArray lattice = grid(4, dimension);
      CHECK(check_repaired(caller, diagram, lattice) == lattice.size());
      // At x = 0 and above; the last layer once more at x = 1, and one seed with another weight.
      translate(lattice, {-0.125, -0.125, dimension == 3 ? -0.125 : 0});
      CHECK(check_repaired(caller, diagram, lattice) == lattice.size());
      const std::size_t n = lattice.size();
      for (std::size_t i = 0; i < n; ++i) {
        if (lattice.coordinate(i, 0) != 0) continue;
        for (int c = 0; c < dimension; ++c)
          lattice.positions.push_back(lattice.coordinate(i, c) + (c == 0 ? 1 : 0));
        lattice.weights.push_back(i % 3 == 0 ? 0.001 : i % 3 == 1 ? -0.001 : 0);
      }
      CHECK(run(caller, diagram, lattice.view()).count(DeviceSeedStatus::duplicate) == lattice.size() - n);
      CHECK(check_repaired(caller, diagram, lattice) > 0);
    }
}

TEST_CASE("centroids are near the seeds as given") {
  Caller& caller = shared_caller();
  for (const Precision precision : precisions(caller)) {
    DeviceDiagram diagram(caller.device(), torus_box(2), in_precision(precision));
    const SeedArray seeds{2, {0.25, 0.5, 5.75, -3.5}, {0, 0}};
    const Output output = run(caller, diagram, seeds.view());
    REQUIRE(output.count(DeviceSeedStatus::ok) == 2);
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(output.centroid[k] == doctest::Approx(seeds.positions[k]).epsilon(1e-5));
    CHECK(output.mass[0] == doctest::Approx(0.5).epsilon(1e-5));
  }
}

TEST_CASE("one seed outweighs all others of a periodic domain") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3})
      for (const double weight : {0.01, 0.1, 10.0}) {
        CAPTURE(dimension);
        CAPTURE(weight);
        DeviceDiagram diagram(caller.device(), torus_box(dimension), in_precision(precision));
        SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 200, dimension, random);
        seeds.weights[17] = weight;
        check_repaired(caller, diagram, seeds);
      }
}

TEST_CASE("invalid seeds of a periodic domain") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const Precision precision : precisions(caller)) {
    const double low[] = {0, 0}, high[] = {1, 1};
    const bool axes[] = {true, false};
    DeviceDiagram diagram(caller.device(), Domain::periodic_box(low, high, axes), in_precision(precision));
    const SeedArray good =
        rounded_seeds(random_seeds(Distribution::white, WeightRange::W1, 200, 2, random), precision);
    SeedArray bad = good;
    const double far = 1e9, near = 1e8;  // 2^28 is 2.7e8
    for (const double x : {nan, inf, -inf, far, -far, 1e30}) bad.push({x, 0.5}, 0);
    bad.push({0.5, nan}, 0);
    bad.push({0.5, 0.5}, inf);
    const std::size_t invalid = bad.size() - good.size();
    const Output expected = run(caller, diagram, good.view()), found = run(caller, diagram, bad.view());
    CHECK(found.count(DeviceSeedStatus::invalid) == invalid);
    for (std::size_t i = 0; i < good.size(); ++i) {
      CHECK(found.status[i] == expected.status[i]);
      CHECK(std::abs(found.mass[i] - expected.mass[i]) <= 1e-7);
    }
    SeedArray distant = good;
    distant.push({near, 0.5}, 0);
    CHECK(run(caller, diagram, distant.view()).count(DeviceSeedStatus::invalid) == 0);
    check_repaired(caller, diagram, distant);
  }
}

TEST_CASE("images beyond their room leave cells unfinished, and never wrong") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    DeviceDiagram diagram(caller.device(), torus_box(2), in_precision(precision));
    const SeedArray seeds =
        rounded_seeds(random_seeds(Distribution::white, WeightRange::W2, 1000, 2, random), precision);
    const Output all = run(caller, diagram, seeds.view());
    REQUIRE(all.count(DeviceSeedStatus::hidden) > 0);
    CHECK(all.count(DeviceSeedStatus::unfinished) < 20);
    diagram.set_image_capacity(100);
    const Output some = run(caller, diagram, seeds.view());
    CHECK(some.count(DeviceSeedStatus::ok) == 0);
    CHECK(some.count(DeviceSeedStatus::unfinished) > 500);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i)
      wrong += some.status[i] == DeviceSeedStatus::hidden && all.status[i] != DeviceSeedStatus::hidden;
    CHECK(wrong == 0);
    check_repaired(caller, diagram, seeds);
    diagram.set_image_capacity(5000);
    const Output again = run(caller, diagram, seeds.view());
    CHECK(again.status == all.status);
    std::size_t different = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i)
      different += all.status[i] != DeviceSeedStatus::unfinished && again.mass[i] != all.mass[i];
    CHECK(different == 0);
  }
}

TEST_CASE("clustered seeds of a periodic domain") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3}) {
      CAPTURE(dimension);
      DeviceDiagram diagram(caller.device(), torus_box(dimension), in_precision(precision));
      check_repaired(caller, diagram,
                     random_seeds(Distribution::cluster, WeightRange::W1, 500, dimension, random));
      // All in a corner, so that cells are as large as the domain.
      SeedArray corner = random_seeds(Distribution::white, WeightRange::W0, 60, dimension, random);
      for (double& x : corner.positions) x *= 0.01;
      check_repaired(caller, diagram, corner);
    }
}

TEST_CASE("periodic rows need shifts, others have none, and short ones are not written") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  DeviceDiagram periodic(caller.device(), torus_box(2)), bounded(caller.device(), unit_box(2));
  const SeedArray seeds =
      rounded_seeds(random_seeds(Distribution::white, WeightRange::W1, 200, 2, random), periodic.precision());
  const Job job(caller, periodic.precision(), seeds.view());
  const Rows with(caller, periodic.precision(), 200, 2000, true),
      without(caller, periodic.precision(), 200, 2000);
  CHECK_THROWS_WITH_AS(job.enqueue(periodic, {without.handles(), {}}),
                       doctest::Contains("the buffer of shifts is null"), Error);
  CHECK_THROWS_WITH_AS(job.enqueue(bounded, {with.handles(), {}}),
                       doctest::Contains("shifts in periodic domains only"), Error);
  job.enqueue(periodic, {with.handles(), {}});
  const Adjacency whole = with.read();
  const Memory shifts(caller, 300 * 3 * sizeof(cl_int));
  DeviceAdjacency few = with.handles();
  few.shift = shifts.handle();
  job.enqueue(periodic, {few, {}});
  CHECK(with.read().offset == whole.offset);
  const auto found = shifts.values<std::array<std::int32_t, 3>>(caller.queue(), 300);
  for (std::size_t i = 0; whole.offset[i + 1] <= 300; ++i)
    for (std::uint64_t k = whole.offset[i]; k < whole.offset[i + 1]; ++k) CHECK(found[k] == whole.shift[k]);
}

TEST_CASE("periodic rows do not depend on the size of launches, bit for bit") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    const SeedArray seeds =
        rounded_seeds(random_seeds(Distribution::white, WeightRange::W1, 400, 3, random), precision);
    const Job job(caller, precision, seeds.view());
    const Rows rows(caller, precision, 400, 10000, true);
    std::vector<Adjacency> found;
    for (const std::size_t chunk : {0u, 37u}) {
      Options options = in_precision(precision);
      options.chunk_pairs = chunk;
      DeviceDiagram diagram(caller.device(), torus_box(3), options);
      job.enqueue(diagram, {rows.handles(), {}});
      found.push_back(rows.read());
    }
    CHECK(found[0].neighbor.size() > 5000);
    CHECK(found[0].neighbor == found[1].neighbor);
    CHECK(found[0].wall == found[1].wall);
    CHECK(found[0].shift == found[1].shift);
  }
}
