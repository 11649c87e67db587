// The walls of DeviceDiagram, in the caller's memory.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>

#include "tests/device_diagram/caller.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Computed {
  Output output;
  Adjacency adjacency;
};

Computed compute(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds, std::size_t room) {
  const Job job(caller, diagram.precision(), seeds);
  const Rows rows(caller, diagram.precision(), seeds.size(), room);
  job.enqueue(diagram, {rows.handles()});
  return {job.read(), rows.read()};
}

/// Rows are ascending and symmetric, and only cells have walls.
void check_form(const Computed& found) {
  const Adjacency& a = found.adjacency;
  REQUIRE(a.offset.back() == a.neighbor.size());
  std::size_t unsorted = 0, one_sided = 0, empty = 0, not_positive = 0;
  for (std::uint32_t i = 0; i + 1 < a.offset.size(); ++i)
    for (std::uint64_t k = a.offset[i]; k < a.offset[i + 1]; ++k) {
      const std::uint32_t j = a.neighbor[k];
      REQUIRE(j + 1 < a.offset.size());
      unsorted += k > a.offset[i] && !(a.neighbor[k - 1] < j);
      const auto begin = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[j]),
                 end = a.neighbor.begin() + static_cast<std::ptrdiff_t>(a.offset[j + 1]);
      const auto back = std::lower_bound(begin, end, i);
      one_sided += back == end || *back != i ||
                   a.wall[static_cast<std::size_t>(back - a.neighbor.begin())] != a.wall[k];
      empty +=
          found.output.status[i] != DeviceSeedStatus::ok || found.output.status[j] != DeviceSeedStatus::ok;
      not_positive += !(a.wall[k] > 0);
    }
  CHECK(unsorted == 0);
  CHECK(one_sided == 0);
  CHECK(empty == 0);
  CHECK(not_positive == 0);
}

/// The walls in which two adjacencies differ by more than `tolerance`; a missing wall has measure 0.
std::size_t differences(const Adjacency& a, const Adjacency& b, double tolerance) {
  std::size_t different = 0;
  for (std::size_t i = 0; i + 1 < a.offset.size(); ++i) {
    std::uint64_t p = a.offset[i], q = b.offset[i];
    while (p < a.offset[i + 1] || q < b.offset[i + 1]) {
      const std::uint32_t j = p < a.offset[i + 1] ? a.neighbor[p] : ~std::uint32_t{0},
                          k = q < b.offset[i + 1] ? b.neighbor[q] : ~std::uint32_t{0};
      const double x = j <= k ? a.wall[p] : 0, y = k <= j ? b.wall[q] : 0;
      different += !(std::abs(x - y) <= tolerance);
      p += j <= k;
      q += k <= j;
    }
  }
  return different;
}

void check_walls_against_host(Caller& caller, DeviceDiagram& diagram, const SeedArray& exact) {
  const SeedArray seeds = rounded_seeds(exact, diagram.precision());
  Options options;
  options.precision = diagram.precision();
  options.decisions = Decisions::fast;
  Diagram on_host(caller.device(), diagram.domain(), options);
  on_host.set_seeds(seeds.view());
  const Adjacency& expected = on_host.adjacency();
  const Computed found = compute(caller, diagram, seeds.view(), expected.neighbor.size() + 100);
  check_form(found);
  // Unfinished cells, of which there are few in single precision alone, have no walls here.
  if (found.output.count(DeviceSeedStatus::unfinished) > 0) return;
  CHECK(differences(found.adjacency, expected, wall_tolerance(diagram.domain(), diagram.precision())) == 0);
  if (diagram.precision() == Precision::float64 && seeds.size() > 100) {
    const auto walls = static_cast<double>(expected.neighbor.size());
    CHECK(std::abs(static_cast<double>(found.adjacency.neighbor.size()) - walls) <= 0.001 * walls);
  }
}

}  // namespace

TEST_CASE("walls in device memory equal those of Diagram") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3}) {
      Options options;
      options.precision = precision;
      DeviceDiagram diagram(caller.device(), unit_box(dimension), options);
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const Distribution distribution : {Distribution::white, Distribution::cluster}) {
          CAPTURE(dimension);
          CAPTURE(name(weights));
          CAPTURE(name(distribution));
          CAPTURE(static_cast<int>(precision));
          check_walls_against_host(
              caller, diagram,
              random_seeds(distribution, weights, number_of_inputs(800u, 2000u), dimension, random));
        }
    }
}

TEST_CASE("walls in domains of several regions equal those of Diagram") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const auto& family : {polygon_domains(), surface_domains(), volume_domains()})
      for (const NamedDomain& domain : family) {
        Options options;
        options.precision = precision;
        DeviceDiagram diagram(caller.device(), domain.domain, options);
        for (const std::size_t n : {3u, 400u}) {
          CAPTURE(domain.name);
          CAPTURE(n);
          CAPTURE(static_cast<int>(precision));
          check_walls_against_host(caller, diagram,
                                   seeds_for(domain.domain, Distribution::white, WeightRange::W1, n, random));
        }
      }
}

TEST_CASE("walls do not depend on the size of launches, bit for bit") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const int dimension : {2, 3}) {
    const SeedArray exact = random_seeds(Distribution::white, WeightRange::W1, 1500, dimension, random);
    Options options;
    DeviceDiagram whole(caller.device(), unit_box(dimension), options);
    const SeedArray seeds = rounded_seeds(exact, whole.precision());
    const Computed expected = compute(caller, whole, seeds.view(), 40000);
    options.chunk_pairs = 64;
    DeviceDiagram parts(caller.device(), unit_box(dimension), options);
    const Computed found = compute(caller, parts, seeds.view(), 40000);
    CHECK(found.adjacency.offset == expected.adjacency.offset);
    CHECK(found.adjacency.neighbor == expected.adjacency.neighbor);
    CHECK(found.adjacency.wall == expected.adjacency.wall);
    // And measures are those of a call without walls.
    const Output alone = run(caller, whole, seeds.view());
    CHECK(alone.mass == expected.output.mass);
    CHECK(alone.second_moment == expected.output.second_moment);
  }
}

TEST_CASE("rows beyond the caller's room are not written, and offsets say how much they need") {
  Caller& caller = shared_caller();
  Random random(1);
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const SeedArray seeds =
      rounded_seeds(random_seeds(Distribution::white, WeightRange::W0, 500, 2, random), diagram.precision());
  const Computed whole = compute(caller, diagram, seeds.view(), 5000);
  REQUIRE(whole.adjacency.offset.back() > 2000);
  const Computed part = compute(caller, diagram, seeds.view(), 1000);
  CHECK(part.adjacency.offset == whole.adjacency.offset);
  CHECK(part.output.mass == whole.output.mass);
  REQUIRE(part.adjacency.neighbor.size() == 1000);
  const auto after = std::upper_bound(whole.adjacency.offset.begin(), whole.adjacency.offset.end(), 1000u);
  const std::uint64_t fits = *(after - 1);
  CHECK(std::equal(whole.adjacency.neighbor.begin(),
                   whole.adjacency.neighbor.begin() + static_cast<std::ptrdiff_t>(fits),
                   part.adjacency.neighbor.begin()));
  for (std::uint64_t k = fits; k < 1000; ++k) CHECK(part.adjacency.neighbor[k] == Rows::unwritten);
}

TEST_CASE("cells whose walls exceed the store are unfinished, and the others are right") {
  Caller& caller = shared_caller();
  Random random(1);
  for (const bool regions : {false, true}) {
    const Domain domain = regions ? polygon_domains().front().domain : unit_box(2);
    DeviceDiagram diagram(caller.device(), domain);
    const SeedArray seeds = rounded_seeds(
        seeds_for(domain, Distribution::white, WeightRange::W0, 500, random), diagram.precision());
    const Computed whole = compute(caller, diagram, seeds.view(), 5000);
    REQUIRE(whole.output.count(DeviceSeedStatus::unfinished) == 0);
    diagram.set_wall_capacity(static_cast<std::uint32_t>(whole.adjacency.neighbor.size() / 2));
    const Computed part = compute(caller, diagram, seeds.view(), 5000);
    const std::size_t unfinished = part.output.count(DeviceSeedStatus::unfinished);
    CHECK(unfinished > whole.output.count(DeviceSeedStatus::ok) / 4);
    CHECK(unfinished < whole.output.count(DeviceSeedStatus::ok));
    check_form(part);
    for (std::size_t i = 0; i < 500; ++i) {
      if (part.output.status[i] == DeviceSeedStatus::unfinished) {
        CHECK(std::isnan(part.output.mass[i]));
        continue;
      }
      CHECK(part.output.status[i] == whole.output.status[i]);
      CHECK(part.output.mass[i] == whole.output.mass[i]);
    }
    diagram.set_wall_capacity(0);
    CHECK(compute(caller, diagram, seeds.view(), 5000).adjacency.wall == whole.adjacency.wall);
  }
}

TEST_CASE("rows of no seeds, of hidden ones and of those left out") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const Rows none(caller, diagram.precision(), 0, 10);
  diagram.enqueue(nullptr, nullptr, 0, {nullptr, nullptr, none.handles()});
  CHECK(none.read().offset == std::vector<std::uint64_t>{0});
  const double nan = std::nan("");
  const std::vector<double> positions = {0.25, 0.5, 0.75, 0.5, 0.75, 0.5, 0.3, 0.5, nan, 0.1};
  const std::vector<double> weights = {0, 0, 0, -1, 0};
  const Computed found = compute(caller, diagram, {2, positions, weights}, 10);
  CHECK(found.output.status[3] == DeviceSeedStatus::hidden);
  CHECK(found.output.status[4] == DeviceSeedStatus::invalid);
  CHECK(found.adjacency.offset == std::vector<std::uint64_t>{0, 1, 2, 2, 2, 2});
  CHECK(found.adjacency.neighbor == std::vector<std::uint32_t>{1, 0});
  CHECK(found.adjacency.wall == std::vector<double>{1, 1});
}

TEST_CASE("buffers of walls that are too small or missing are refused before anything is enqueued") {
  Caller& caller = shared_caller();
  Random random(1);
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 20, 2, random);
  const Job job(caller, diagram.precision(), seeds.view());
  const Rows rows(caller, diagram.precision(), 20, 200), small(caller, diagram.precision(), 10, 200);
  DeviceAdjacency wrong = rows.handles();
  wrong.offset = small.handles().offset;
  CHECK_THROWS_WITH_AS(job.enqueue(diagram, {wrong}), doctest::Contains("offsets has 44 bytes; it needs 84"),
                       Error);
  wrong = rows.handles();
  wrong.wall = nullptr;
  CHECK_THROWS_WITH_AS(job.enqueue(diagram, {wrong}), doctest::Contains("the buffer of walls is null"),
                       Error);
  Caller other;
  const Rows foreign(other, diagram.precision(), 20, 200);
  wrong = rows.handles();
  wrong.neighbor = foreign.handles().neighbor;
  CHECK_THROWS_WITH_AS(job.enqueue(diagram, {wrong}), doctest::Contains("belongs to another context"), Error);
  CHECK_THROWS_AS(diagram.set_wall_capacity(0x80000001u), Error);
}
