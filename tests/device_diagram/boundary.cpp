// The parts of the domain's boundary that the cells of DeviceDiagram have, in the caller's memory.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <powercell/diagram.hpp>

#include "tests/device_diagram/caller.hpp"
#include "tests/device_diagram/repaired.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct FoundBoundary {
  Output output;
  BoundaryWalls walls;
  Adjacency adjacency;
  std::vector<std::uint32_t> list;
};

constexpr std::size_t enough = 20000;  // entries of rows

/// \param walls  whether the adjacency is wanted too
FoundBoundary find_boundary(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds,
                            bool repair = false, bool walls = true) {
  const Job job(caller, diagram.precision(), seeds);
  const Rows rows(caller, diagram.precision(), seeds.size(), enough, diagram.domain().is_periodic());
  const BoundaryRows boundary(caller, diagram.precision(), seeds.size(), enough);
  const List list(caller, seeds.size());
  const Wanted wanted{walls ? rows.handles() : DeviceAdjacency{}, list.handles(), {}, boundary.handles()};
  job.enqueue(diagram, wanted);
  if (repair) job.repair(diagram, wanted);
  FoundBoundary found{job.read(), boundary.read(), {}, list.read()};
  if (walls) found.adjacency = rows.read();
  return found;
}

/// Whether row i has the same facets in both, with measures that differ by `error` at most.
bool same_row(const BoundaryWalls& a, const BoundaryWalls& b, std::size_t i, double error) {
  if (a.offset[i + 1] - a.offset[i] != b.offset[i + 1] - b.offset[i]) return false;
  for (std::uint64_t k = a.offset[i], m = b.offset[i]; k < a.offset[i + 1]; ++k, ++m)
    if (a.facet[k] != b.facet[m] || !(std::abs(a.measure[k] - b.measure[m]) <= error)) return false;
  return true;
}

/// Rows ascend, have measures, and belong to cells that are there.
void check_form(const FoundBoundary& found) {
  const BoundaryWalls& walls = found.walls;
  REQUIRE(walls.offset.front() == 0);
  REQUIRE(walls.offset.back() == walls.facet.size());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i + 1 < walls.offset.size(); ++i)
    for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k)
      wrong += found.output.status[i] != DeviceSeedStatus::ok || !(walls.measure[k] > 0) ||
               (k > walls.offset[i] && walls.facet[k - 1] >= walls.facet[k]);
  CHECK(wrong == 0);
}

/// The rows of cells that are not on the list, or of all where it is empty, are those of `host`.
void check_rows_of(const FoundBoundary& found, Diagram& host) {
  const BoundaryWalls& expected = host.boundary_walls();
  const double error = wall_tolerance(host.domain(), host.precision());
  std::size_t different = 0;
  for (std::uint32_t i = 0; i < host.size(); ++i)
    different += !std::binary_search(found.list.begin(), found.list.end(), i) &&
                 !same_row(found.walls, expected, i, error);
  CHECK(different == 0);
}

/// Compares with an exact Diagram: cells that are certain, and after a repair all.
/// \return how many cells were uncertain
std::size_t check_boundary(Caller& caller, DeviceDiagram& diagram, const SeedArray& given) {
  const SeedArray seeds = rounded_seeds(given, diagram.precision());
  Diagram exact(caller.device(), diagram.domain(), in_precision(diagram.precision()));
  exact.set_seeds(seeds.view());
  const FoundBoundary before = find_boundary(caller, diagram, seeds.view());
  check_form(before);
  check_rows_of(before, exact);
  const FoundBoundary alone = find_boundary(caller, diagram, seeds.view(), false, false);
  CHECK(alone.walls.offset == before.walls.offset);
  CHECK(alone.walls.facet == before.walls.facet);
  CHECK(alone.walls.measure == before.walls.measure);
  if (before.list.empty()) return 0;
  FoundBoundary after = find_boundary(caller, diagram, seeds.view(), true);
  after.list.clear();
  check_form(after);
  check_rows_of(after, exact);
  CHECK(after.adjacency.neighbor == exact.adjacency().neighbor);
  return before.list.size();
}

double total(const BoundaryWalls& walls) {
  return std::accumulate(walls.measure.begin(), walls.measure.end(), 0.0);
}

}  // namespace

TEST_CASE("boundary walls in device memory are those of Diagram, before and after repair") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    std::size_t repaired = 0;
    for (const auto& family :
         {polygon_domains(), surface_domains(), volume_domains(), box_domains(), periodic_domains()})
      for (const NamedDomain& domain : family) {
        DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
        for (const WeightRange weights : {WeightRange::W0, WeightRange::W2})
          for (const std::size_t n : {2u, 80u}) {
            CAPTURE(domain.name);
            CAPTURE(n);
            CAPTURE(name(weights));
            CAPTURE(static_cast<int>(precision));
            repaired += check_boundary(caller, diagram,
                                       seeds_for(domain.domain, Distribution::white, weights, n, random));
          }
      }
    MESSAGE("precision ", static_cast<int>(precision), ": ", repaired, " cells were repaired");
  }
}

TEST_CASE("boundary walls of seeds that tie, and of seeds and bisectors in the boundary") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    for (const int dimension : {2, 3}) {
      CAPTURE(dimension);
      DeviceDiagram diagram(caller.device(), unit_box(dimension), in_precision(precision));
      CHECK(check_boundary(caller, diagram, grid(4, dimension)) > 0);
      SeedArray on = grid(3, dimension);  // on the boundary, its corners too
      for (double& x : on.positions) x = 0.75 * (x - 0.5) * 2 + 0.5;
      on.positions.front() = 0;
      check_boundary(caller, diagram, on);
      SeedArray corners{dimension, {}, {0, 0, 0}};
      for (const double x : {0.0, 1.0, 0.5})
        for (int k = 0; k < dimension; ++k) corners.positions.push_back(k == 0 ? x : 1);
      check_boundary(caller, diagram, corners);
    }
    // The bisector is in a side of the square: the cell outside has no part of it.
    DeviceDiagram square(caller.device(), unit_box(2), in_precision(precision));
    const SeedArray two{2, {0.25, 0.5, -0.25, 0.5}, {0, 0}};
    check_boundary(caller, square, two);
    const FoundBoundary found = find_boundary(caller, square, two.view(), true);
    CHECK(found.walls.offset == std::vector<std::uint64_t>{0, 4, 4});
    CHECK(found.walls.facet == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(found.output.status[1] == DeviceSeedStatus::hidden);
  }
}

TEST_CASE("a cell that only touches a region has no part of its boundary") {
  Caller& caller = shared_caller();
  Parts squares(2);
  squares[0].outer = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  squares[1].outer = {{2, 0}, {3, 0}, {3, 1}, {2, 1}};
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    DeviceDiagram diagram(caller.device(), Domain::polygon(squares), in_precision(precision));
    const SeedArray seeds{2, {1, 0.5, 3, 0.5}, {0, 0}};  // the bisector is x = 2
    check_boundary(caller, diagram, seeds);
    for (const bool repair : {false, true}) {
      const BoundaryWalls walls = find_boundary(caller, diagram, seeds.view(), repair).walls;
      CHECK(walls.offset == std::vector<std::uint64_t>{0, 4, 8});
      CHECK(walls.facet == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7});
    }
    // Moved into the other square: by less than the device can tell, so that the piece there counts as one
    // without thickness, up to a piece with sides of its own.
    Options options = in_precision(precision);
    options.decisions = Decisions::fast;
    Diagram fast(caller.device(), diagram.domain(), options);
    for (int bits = 54; bits > 10; --bits) {
      CAPTURE(bits);
      const SeedArray moved{2, seeds.positions, {std::ldexp(1.0, -bits), 0}};
      fast.set_seeds(moved.view());
      const BoundaryWalls found = find_boundary(caller, diagram, moved.view()).walls;
      CHECK(found.offset == fast.boundary_walls().offset);
      CHECK(found.facet == fast.boundary_walls().facet);
    }
  }
}

TEST_CASE("cells whose walls run through corners of the domain have no facets without measure") {
  Caller& caller = shared_caller();
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    DeviceDiagram square(caller.device(), unit_box(2), in_precision(precision)),
        cube(caller.device(), unit_box(3), in_precision(precision)),
        octahedron(caller.device(), surface_of(icosphere(0)), in_precision(precision));
    const SeedArray flat{2, {0.75, 0.25, 0.25, 0.75}, {0, 0}},
        deep{3, {0.75, 0.25, 0.5, 0.25, 0.75, 0.5}, {0, 0}},
        mirrored{3, {0.5, 0, 0, -0.5, 0, 0, 0, 0.5, 0, 0, -0.5, 0}, {0, 0, 0, 0}};
    check_boundary(caller, square, flat);
    check_boundary(caller, cube, deep);
    check_boundary(caller, octahedron, mirrored);
    for (const bool repair : {false, true}) {
      const BoundaryWalls walls = find_boundary(caller, square, flat.view(), repair).walls;
      CHECK(walls.offset == std::vector<std::uint64_t>{0, 2, 4});
      CHECK(walls.facet == std::vector<std::uint32_t>{0, 1, 2, 3});
    }
  }
}

TEST_CASE("boundary walls of hidden, duplicate, invalid and unfinished seeds, and of none") {
  Caller& caller = shared_caller();
  const Domain square = unit_box(2);
  DeviceDiagram diagram(caller.device(), square);
  const BoundaryRows none(caller, diagram.precision(), 0, 1);
  diagram.enqueue(nullptr, nullptr, 0, {nullptr, nullptr, {}, {}, {}, none.handles()});
  CHECK(none.read().offset == std::vector<std::uint64_t>{0});

  const double nan = std::nan("");
  const std::vector<double> positions = {nan, 0.1, 0.25, 0.5, 0.75, 0.5, 0.75, 0.5, 0.3, 0.5};
  const std::vector<double> weights = {0, 0, 0, 0, -1};
  const FoundBoundary two = find_boundary(caller, diagram, {2, positions, weights});
  CHECK(two.output.status[3] == DeviceSeedStatus::duplicate);
  CHECK(two.output.status[4] == DeviceSeedStatus::hidden);
  CHECK(two.walls.offset == std::vector<std::uint64_t>{0, 0, 3, 6, 6, 6});
  CHECK(two.walls.facet == std::vector<std::uint32_t>{0, 2, 3, 0, 1, 2});  // edges are -y +x +y -x
  CHECK(two.walls.measure == std::vector<double>{0.5, 0.5, 1, 0.5, 1, 0.5});

  SeedArray many = cospherical(300, 2);
  many.push({0.5, 0.5}, 0);
  const FoundBoundary found = find_boundary(caller, diagram, many.view());
  CHECK(found.output.status[300] == DeviceSeedStatus::unfinished);
  CHECK(std::abs(total(found.walls) - 4) < 40 * tolerance(diagram.precision()));
  CHECK(find_boundary(caller, diagram, many.view(), true).walls.facet == found.walls.facet);
}

TEST_CASE("boundary walls do not depend on the size of launches, nor walls on them, bit for bit") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const NamedDomain& domain : one_of_each()) {
    CAPTURE(domain.name);
    const SeedArray exact = seeds_for(domain.domain, Distribution::white, WeightRange::W1, 200, random);
    DeviceDiagram whole(caller.device(), domain.domain);
    const SeedArray seeds = rounded_seeds(exact, whole.precision());
    const FoundBoundary expected = find_boundary(caller, whole, seeds.view());
    Options options;
    options.chunk_pairs = 37;
    DeviceDiagram parts(caller.device(), domain.domain, options);
    const FoundBoundary found = find_boundary(caller, parts, seeds.view());
    CHECK(found.walls.offset == expected.walls.offset);
    CHECK(found.walls.facet == expected.walls.facet);
    CHECK(found.walls.measure == expected.walls.measure);
    const Job job(caller, whole.precision(), seeds.view());
    const Rows rows(caller, whole.precision(), seeds.size(), enough);
    job.enqueue(whole, {rows.handles()});
    CHECK(rows.read().neighbor == expected.adjacency.neighbor);
    CHECK(rows.read().wall == expected.adjacency.wall);
  }
}

TEST_CASE("boundary walls beyond the caller's room are not written, and their offsets are right") {
  Caller& caller = shared_caller();
  Random random(1);
  DeviceDiagram diagram(caller.device(), unit_box(3));
  const Precision precision = diagram.precision();
  const SeedArray seeds =
      rounded_seeds(random_seeds(Distribution::white, WeightRange::W1, 300, 3, random), precision);
  const BoundaryWalls whole = find_boundary(caller, diagram, seeds.view()).walls;
  CHECK(std::abs(total(whole) - 6) < 60 * tolerance(precision));
  const Job job(caller, precision, seeds.view());
  const std::size_t room = whole.facet.size() / 2;
  const BoundaryRows half(caller, precision, seeds.size(), room);
  const List list(caller, seeds.size());
  job.enqueue(diagram, {{}, list.handles(), {}, half.handles()});
  const BoundaryWalls found = half.read();
  CHECK(found.offset == whole.offset);
  const std::size_t end = *std::prev(std::upper_bound(whole.offset.begin(), whole.offset.end(), room));
  REQUIRE(end > room / 2);
  for (std::size_t k = 0; k < room; ++k)
    CHECK(found.facet[k] == (k < end ? whole.facet[k] : BoundaryRows::unwritten));
  CHECK(std::equal(found.measure.begin(), found.measure.begin() + static_cast<std::ptrdiff_t>(end),
                   whole.measure.begin()));
}

TEST_CASE("the repair of boundary walls that do not fit is refused, with the room that they need") {
  Caller& caller = shared_caller();
  DeviceDiagram diagram(caller.device(), unit_box(2));
  const SeedArray seeds = grid(6, 2);
  const std::size_t needed = find_boundary(caller, diagram, seeds.view(), true).walls.facet.size();
  CHECK(needed == 24);
  const Job job(caller, diagram.precision(), seeds.view());
  const List list(caller, seeds.size());
  const BoundaryRows few(caller, diagram.precision(), seeds.size(), 5);
  job.enqueue(diagram, {{}, list.handles(), {}, few.handles()});
  REQUIRE(few.read().offset.back() > 5);
  CHECK_THROWS_WITH_AS(job.repair(diagram, {{}, list.handles(), {}, few.handles()}),
                       doctest::Contains("have room for 5, so that some rows were not written"), Error);
  // A cell that is unfinished has no facets until it is repaired.
  diagram.set_wall_capacity(1);
  const BoundaryRows tight(caller, diagram.precision(), seeds.size(), needed - 1);
  job.enqueue(diagram, {{}, list.handles(), {}, tight.handles()});
  CHECK(tight.read().offset.back() <= 1);
  CHECK_THROWS_WITH_AS(job.repair(diagram, {{}, list.handles(), {}, tight.handles()}),
                       doctest::Contains("the repaired boundary walls have 24 entries"), Error);
  CHECK(job.read().count(DeviceSeedStatus::unfinished) > 0);  // nothing is changed
  const BoundaryRows exact(caller, diagram.precision(), seeds.size(), needed);
  job.enqueue(diagram, {{}, list.handles(), {}, exact.handles()});
  job.repair(diagram, {{}, list.handles(), {}, exact.handles()});
  CHECK(exact.read().facet.size() == needed);
  CHECK(job.read().count(DeviceSeedStatus::ok) == 36);

  for (const auto& [member, name] :
       {std::pair(&DeviceBoundaryWalls::offset, "the offsets of boundary walls is null"),
        std::pair(&DeviceBoundaryWalls::facet, "the facets of boundary walls is null"),
        std::pair(&DeviceBoundaryWalls::measure, "the measures of boundary walls is null")}) {
    DeviceBoundaryWalls wrong = exact.handles();
    wrong.*member = nullptr;
    CHECK_THROWS_WITH_AS(job.enqueue(diagram, {{}, {}, {}, wrong}), doctest::Contains(name), Error);
  }
}

TEST_CASE("boundary walls of few seeds in regions of many facets have room") {
  Caller& caller = shared_caller();
  constexpr std::size_t side = 14, corners = 64;  // discs apart from each other
  Parts discs(side * side);
  for (std::size_t disc = 0; disc < discs.size(); ++disc)
    for (std::size_t k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(k) / corners;
      discs[disc].outer.push_back({static_cast<double>(disc % side) + 0.4 * std::cos(angle),
                                   static_cast<double>(disc / side) + 0.4 * std::sin(angle)});
    }
  DeviceDiagram diagram(caller.device(), Domain::polygon(discs));
  const SeedArray seeds{2, {3.1, 4.2, 9.3, 8.4, 2.2, 10.1}, {0, 0, 0}};
  for (const bool walls : {false, true}) {
    const FoundBoundary found = find_boundary(caller, diagram, seeds.view(), false, walls);
    CHECK(found.output.count(DeviceSeedStatus::ok) == 3);
    CHECK(found.walls.facet.size() >= side * side * corners);
  }
}

TEST_CASE("boundary walls have room where each cell has parts of two facets or more") {
  Caller& caller = shared_caller();
  Random random(1);
  constexpr std::size_t n = 3000;
  SeedArray strips{2, {}, {}}, columns{3, {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    strips.push({(static_cast<double>(i) + 0.5) / n, 0.5}, 0);
    columns.push({random.uniform(0, 1), random.uniform(0, 1), 0.5}, 0);
  }
  for (const SeedArray* seeds : {&strips, &columns})
    for (const bool walls : {false, true}) {
      CAPTURE(seeds->dimension);
      CAPTURE(walls);
      DeviceDiagram diagram(caller.device(), unit_box(seeds->dimension));
      const SeedArray there = rounded_seeds(*seeds, diagram.precision());
      const FoundBoundary found = find_boundary(caller, diagram, there.view(), false, walls);
      CHECK(found.output.count(DeviceSeedStatus::ok) == n);
      CHECK(found.walls.facet.size() >= 2 * n + 2);
    }
}
