// The cells that a DeviceDiagram leaves to the host, and its results after repair().
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <powercell/diagram.hpp>

#include "tests/device_diagram/repaired.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("after repair, everything in a box is that of an exact Diagram") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3}) {
      std::size_t computed = 0;
      const std::size_t n = number_of_inputs(1000u, 3000u);
      DeviceDiagram diagram(caller.device(), unit_box(dimension), in_precision(precision));
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
          CAPTURE(dimension);
          CAPTURE(name(weights));
          CAPTURE(name(distribution));
          CAPTURE(static_cast<int>(precision));
          computed +=
              check_repaired(caller, diagram, random_seeds(distribution, weights, n, dimension, random));
        }
      MESSAGE(dimension, "D, precision ", static_cast<int>(precision), ": ", computed, " of ", 6 * n,
              " cells");
    }
}

TEST_CASE("after repair, everything in domains of several regions is that of an exact Diagram") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const auto& family : {polygon_domains(), surface_domains(), volume_domains(), box_domains()})
      for (const NamedDomain& domain : family) {
        DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
        for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
          for (const std::size_t n : {3u, number_of_inputs(150u, 400u)}) {
            CAPTURE(domain.name);
            CAPTURE(n);
            CAPTURE(name(weights));
            CAPTURE(static_cast<int>(precision));
            check_repaired(caller, diagram,
                           seeds_for(domain.domain, Distribution::white, weights, n, random));
          }
      }
}

TEST_CASE("repair of seeds that tie") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    for (const int dimension : {2, 3}) {
      CAPTURE(dimension);
      DeviceDiagram diagram(caller.device(), unit_box(dimension), in_precision(precision));
      SeedArray lattice = grid(6, dimension);
      CHECK(check_repaired(caller, diagram, lattice) == lattice.size());
      for (double& w : lattice.weights) w = 0.25 * static_cast<double>(random.index(3)) / 36;
      CHECK(check_repaired(caller, diagram, lattice) > 0);
      check_repaired(caller, diagram, cospherical(60, dimension));
      // One cell ties, the others do not.
      SeedArray one = random_seeds(Distribution::white, WeightRange::W0, 300, dimension, random);
      one.push({0.25, 0.5, 0.5}, 0);
      one.positions.resize(301 * static_cast<std::size_t>(dimension));
      one.push({0.25, 0.5, 0.5}, 0);
      one.positions.resize(302 * static_cast<std::size_t>(dimension));
      check_repaired(caller, diagram, one);
    }
    // Bisectors in facets of the domain and between its regions; cells that are flat.
    DeviceDiagram cube(caller.device(), volume_of(cube_tetrahedra(4, 0, random)), in_precision(precision));
    for (const int side : {4, 5}) CHECK(check_repaired(caller, cube, grid(side, 3)) > 0);
    DeviceDiagram square(caller.device(), Domain::polygon(letter_u()), in_precision(precision));
    for (const int side : {4, 5, 8}) check_repaired(caller, square, grid(side, 2));
    for (const double place : {0.375, 0.5, 0.625}) {
      DeviceDiagram box(caller.device(), unit_box(2), in_precision(precision));
      const SeedArray flat{
          2, {0.25, 0.5, 0.75, 0.5, place, 0.5}, {0, 0, (place - 0.5) * (place - 0.5) - 0.0625}};
      check_repaired(caller, box, flat);
    }
  }
}

TEST_CASE("repair of a cell with more faces than the device's capacities") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3}) {
      CAPTURE(dimension);
      DeviceDiagram diagram(caller.device(), unit_box(dimension), in_precision(precision));
      SeedArray seeds = cospherical(600, dimension);
      for (double& x : seeds.positions) x += random.uniform(-1e-4, 1e-4);
      seeds.positions.insert(seeds.positions.end(), static_cast<std::size_t>(dimension), 0.5);
      seeds.weights.push_back(0);
      const Output output = run(caller, diagram, rounded_seeds(seeds, precision).view());
      REQUIRE(output.status.back() == DeviceSeedStatus::unfinished);
      CHECK(check_repaired(caller, diagram, seeds) > 0);
    }
}

TEST_CASE("repair where pairs and walls exceed their room") {
  Caller& caller = shared_caller();
  Random random(1);
  const Domain domain = Domain::polygon(square_with_holes());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 1000, 2, random);
  DeviceDiagram diagram(caller.device(), domain);
  diagram.set_pair_capacity(500);
  CHECK(check_repaired(caller, diagram, seeds) > 100);
  diagram.set_pair_capacity(0);
  diagram.set_wall_capacity(2000);
  CHECK(check_repaired(caller, diagram, seeds) > 100);
}

TEST_CASE("repair leaves invalid seeds out, and duplicates as they are") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const Precision precision : precisions(caller)) {
    DeviceDiagram diagram(caller.device(), unit_box(2), in_precision(precision));
    const SeedArray good = rounded_seeds(grid(7, 2), precision);
    SeedArray bad{2, {nan, 0.5, 0.5, inf}, {0, 0}};  // before the good ones, between and behind them
    for (std::size_t i = 0; i < good.size(); ++i) {
      bad.push({good.coordinate(i, 0), good.coordinate(i, 1)}, 0);
      if (i % 5 == 0) bad.push({0.3, 0.3}, i % 2 == 0 ? nan : inf);
      if (i % 7 == 0) bad.push({good.coordinate(i, 0), good.coordinate(i, 1)}, i % 2 == 0 ? 0 : -1);
    }
    bad.push({-inf, nan}, nan);
    Diagram exact(caller.device(), unit_box(2), in_precision(precision));
    exact.set_seeds(good.view());
    const Repaired found = repaired(caller, diagram, bad.view(), 1000);
    CHECK(found.list.size() == good.size());
    std::vector<std::uint32_t> number;
    for (std::uint32_t i = 0; i < bad.size(); ++i) {
      CHECK((found.before.status[i] == DeviceSeedStatus::invalid) ==
            (found.output.status[i] == DeviceSeedStatus::invalid));
      CHECK(std::isnan(found.output.mass[i]) == (found.output.status[i] == DeviceSeedStatus::invalid));
      if (found.output.status[i] == DeviceSeedStatus::ok) number.push_back(i);
    }
    CHECK(found.output.count(DeviceSeedStatus::duplicate) == 7);
    REQUIRE(number.size() == good.size());
    for (std::size_t k = 0; k < number.size(); ++k) {
      const std::uint32_t i = number[k];
      CHECK(same_bits(found.output, i, exact.measures(), k, precision));
      Seeds expected;
      for (std::uint64_t w = exact.adjacency().offset[k]; w < exact.adjacency().offset[k + 1]; ++w)
        expected.push_back(number[exact.adjacency().neighbor[w]]);
      CHECK(Seeds(found.adjacency.neighbor.begin() + static_cast<std::ptrdiff_t>(found.adjacency.offset[i]),
                  found.adjacency.neighbor.begin() +
                      static_cast<std::ptrdiff_t>(found.adjacency.offset[i + 1])) == expected);
    }
    const SeedArray none{2, {nan, nan, inf, 0}, {0, 0}};
    const Repaired nothing = repaired(caller, diagram, none.view(), 10);
    CHECK(nothing.list.empty());
    CHECK(nothing.output.count(DeviceSeedStatus::invalid) == 2);
  }
}

TEST_CASE("repair of seeds that differ less than the device can tell") {
  Caller& caller = shared_caller();
  const double tiny = std::numeric_limits<double>::denorm_min();
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    const double least = precision == Precision::float64 ? tiny : 0x1p-149;
    const double low[] = {0, 0}, high[] = {3, 3};
    DeviceDiagram diagram(caller.device(), Domain::box(low, high), in_precision(precision));
    // Different positions, and weights of seeds at one position, which underflow: all cells are computed.
    CHECK(check_repaired(caller, diagram, {2, {0, least, least, least, least, 0, 2, 1}, {0, 0, 0, 0}}) == 4);
    CHECK(check_repaired(caller, diagram, {2, {1, 1, 1, 1, 2, 1, 1, 1}, {0, least, 0, 2 * least}}) == 4);
  }
}

// The frame is centred in two parts. The low one was once 0, so that seeds moved by a rounding error of the
// centre.
TEST_CASE("a domain far from the origin") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const double low[] = {1e14, 1e14}, high[] = {1.00001e14, 1.00001e14};
  for (const Precision precision : precisions(caller)) {
    DeviceDiagram diagram(caller.device(), Domain::box(low, high), in_precision(precision));
    check_repaired(caller, diagram,
                   random_seeds(Distribution::white, WeightRange::W1, 200, 2, random,
                                {{1e14, 1e14, 0}, {1.00001e14, 1.00001e14, 0}}));
  }
}

TEST_CASE("a list that is too small says how many seeds there are, and is not repaired") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const SeedArray seeds = grid(6, 2);
  const Job job(caller, diagram.precision(), seeds.view());
  const List small(caller, 10), large(caller, 36);
  job.enqueue(diagram, {{}, large.handles()});
  const Seeds all = large.read();
  REQUIRE(all.size() == 36);
  job.enqueue(diagram, {{}, small.handles()});
  CHECK(small.count() == 36);
  CHECK(small.read(10) == Seeds(all.begin(), all.begin() + 10));
  CHECK_THROWS_WITH_AS(job.repair(diagram, {{}, small.handles()}),
                       doctest::Contains("36 seeds are uncertain, and their list has room for 10"), Error);
  job.enqueue(diagram, {{}, large.handles()});
  CHECK(job.repair(diagram, {{}, large.handles()}) == 36);
  CHECK(job.repair(diagram, {{}, large.handles()}) == 36);  // once more changes nothing
  CHECK(job.read().mass[0] == doctest::Approx(1.0 / 36).epsilon(1e-5));
}

TEST_CASE("rows that do not fit are refused, with the room that they need") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  SeedArray seeds = cospherical(300, 2);
  seeds.push({0.5, 0.5}, 0);  // unfinished, and so without walls until it is repaired
  const Job job(caller, diagram.precision(), seeds.view());
  const List list(caller, 301);
  const auto rows_of = [&](std::size_t room) { return Rows(caller, diagram.precision(), 301, room); };
  const Rows small = rows_of(50), large = rows_of(2000);
  job.enqueue(diagram, {small.handles(), list.handles()});
  CHECK_THROWS_WITH_AS(job.repair(diagram, {small.handles(), list.handles()}),
                       doctest::Contains("have room for 50, so that some rows were not written"), Error);
  job.enqueue(diagram, {large.handles(), list.handles()});
  const std::size_t before = large.read().neighbor.size();
  job.repair(diagram, {large.handles(), list.handles()});
  const std::size_t needed = large.read().neighbor.size();
  REQUIRE(needed >= before + 600);

  const Rows tight = rows_of(needed - 1), exact = rows_of(needed);
  job.enqueue(diagram, {tight.handles(), list.handles()});
  const std::string message =
      "has " + std::to_string(needed) + " entries, and the buffers of neighbors and walls have room for";
  CHECK_THROWS_WITH_AS(job.repair(diagram, {tight.handles(), list.handles()}),
                       doctest::Contains(message.c_str()), Error);
  CHECK(job.read().count(DeviceSeedStatus::unfinished) == 1);  // nothing is changed
  CHECK(tight.read().neighbor.size() == before);
  job.enqueue(diagram, {exact.handles(), list.handles()});
  job.repair(diagram, {exact.handles(), list.handles()});
  CHECK(exact.read().neighbor == large.read().neighbor);
  CHECK(exact.read().wall == large.read().wall);
}

TEST_CASE("the list of no seeds, of seeds that are certain, and no list") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const List list(caller, 10);
  diagram.enqueue(nullptr, nullptr, 0, {nullptr, nullptr, {}, list.handles()});
  CHECK(list.count() == 0);
  CHECK(diagram.repair(nullptr, nullptr, 0, {nullptr, nullptr, {}, list.handles()}) == 0);
  const SeedArray seeds{2, {0.21, 0.32, 0.73, 0.44, 0.55, 0.86}, {0, 0, 0}};
  const Job job(caller, diagram.precision(), seeds.view());
  job.enqueue(diagram, {{}, list.handles()});
  CHECK(list.count() == 0);
  CHECK(job.repair(diagram, {{}, list.handles()}) == 0);
  CHECK_THROWS_WITH_AS(job.repair(diagram, {}), doctest::Contains("no list of uncertain seeds"), Error);
  DeviceUncertain wrong = list.handles();
  wrong.seeds = nullptr;
  CHECK_THROWS_WITH_AS(job.enqueue(diagram, {{}, wrong}), doctest::Contains("uncertain seeds is null"),
                       Error);
  wrong = list.handles();
  wrong.count = nullptr;
  CHECK_THROWS_WITH_AS(job.enqueue(diagram, {{}, wrong}), doctest::Contains("uncertain seeds is null"),
                       Error);
}

TEST_CASE("repair after new weights and places, and the same again") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    DeviceDiagram diagram(caller.device(), unit_box(3), in_precision(precision));
    SeedArray seeds = grid(5, 3);
    for (int round = 0; round < 3; ++round) {
      check_repaired(caller, diagram, seeds);
      for (double& w : seeds.weights) w = 0.01 * static_cast<double>(random.index(2));
    }
    translate(seeds, {0.03125, 0, 0});
    check_repaired(caller, diagram, seeds);
    check_repaired(caller, diagram, grid(4, 3));
    seeds.positions.insert(seeds.positions.end(), {0.1, 0.1, std::nan("")});
    seeds.weights.push_back(0);
    CHECK(repaired(caller, diagram, seeds.view(), 4000).output.count(DeviceSeedStatus::invalid) == 1);
    seeds.positions.resize(375);
    seeds.weights.resize(125);
    check_repaired(caller, diagram, seeds);
  }
}

TEST_CASE("entries of a list that enqueue() has not written are refused") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const SeedArray seeds{2, {0.2, 0.3, 0.7, 0.4, std::nan(""), 0}, {0, 0, 0}};
  const Job job(caller, diagram.precision(), seeds.view());
  job.enqueue(diagram, {});
  const cl_uint one = 1;
  const Memory count(caller, sizeof one, &one);
  for (const auto& [entry, message] :
       {std::pair(3u, "there are 3 seeds"), std::pair(2u, "seed 2 of the list")}) {
    const cl_uint value = entry;
    const Memory list(caller, sizeof value, &value);
    CHECK_THROWS_WITH_AS(job.repair(diagram, {{}, {count.handle(), list.handle()}}),
                         doctest::Contains(message), Error);
  }
}
