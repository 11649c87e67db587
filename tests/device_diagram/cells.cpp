// The geometry of the cells of DeviceDiagram, in the caller's memory.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <powercell/diagram.hpp>

#include "tests/device_diagram/cell_memory.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Options options_in(Precision precision, Decisions decisions = Decisions::exact) {
  Options options;
  options.precision = precision;
  options.decisions = decisions;
  return options;
}

/// Vertices of a certain cell are known to a part of its radius (kernels/layout.h, MARGIN_BITS), and rounded
/// to the precision.
double vertex_error(const Cells& cells, std::size_t i, const double* seed, Precision precision) {
  const bool wide = precision == Precision::float64;
  double largest = 0;
  for (int k = 0; k < cells.dimension; ++k) largest = std::max(largest, std::abs(seed[k]));
  const double reach = reach_of(cells, i, seed);
  return reach * (wide ? 0x1p-20 : 0x1p-5) + (largest + reach) * (wide ? 0x1p-50 : 0x1p-21);
}

struct FoundCells {
  Output output;
  Cells cells;
  std::vector<std::uint32_t> list;
};

FoundCells find_cells(Caller& caller, DeviceDiagram& diagram, const SeedsView& seeds, CellRoom room,
                      bool repair = false) {
  const Job job(caller, diagram.precision(), seeds);
  const CellMemory memory(caller, diagram.precision(), diagram.domain(), seeds.size(), room);
  const List list(caller, seeds.size());
  const Wanted wanted{{}, list.handles(), memory.handles()};
  job.enqueue(diagram, wanted);
  if (repair) job.repair(diagram, wanted);
  return {job.read(), memory.read(), list.read()};
}

/// The offsets agree with the counts, only cells that are ok have pieces, and each piece is closed and as
/// large as its cell's measure says.
void check_whole(const FoundCells& found, const Domain& domain, Precision precision) {
  const Cells& cells = found.cells;
  const std::size_t n = cells.cell_count();
  REQUIRE(cells.cell_offset.front() == 0);
  REQUIRE(cells.vertex_offset.front() == 0);
  REQUIRE(cells.face_offset.front() == 0);
  const double mean = domain.measure() / static_cast<double>(n);
  std::size_t wrong = 0, without = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool ok = found.output.status[i] == DeviceSeedStatus::ok;
    without += ok != (cells.cell_offset[i + 1] > cells.cell_offset[i]);
    if (ok)
      wrong += !(std::abs(measure_of_cell(cells, i) - found.output.mass[i]) <=
                 tolerance(precision) * (mean + found.output.mass[i]));
  }
  CHECK(without == 0);
  CHECK(wrong == 0);
}

/// Cells that are not on the list are those of `host`.
void check_cells_of(const FoundCells& found, Diagram& host, const std::vector<double>& positions) {
  const auto d = static_cast<std::size_t>(host.domain().dimension());
  const Cells& expected = host.cells();
  std::size_t different = 0, status = 0;
  for (std::uint32_t i = 0; i < host.size(); ++i) {
    if (std::binary_search(found.list.begin(), found.list.end(), i)) continue;
    status += static_cast<int>(found.output.status[i]) != static_cast<int>(host.measures().status[i]);
    different +=
        !same_cell(found.cells, expected, i, vertex_error(expected, i, &positions[i * d], host.precision()));
  }
  CHECK(status == 0);
  CHECK(different == 0);
}

/// Compares with Diagram: fast before the repair, where that is certain, and all cells with an exact one
/// after it. \return how many cells were uncertain
std::size_t check_geometry(Caller& caller, DeviceDiagram& diagram, const SeedArray& given) {
  const Precision precision = diagram.precision();
  const SeedArray seeds = rounded_seeds(given, precision);
  Diagram fast(caller.device(), diagram.domain(), options_in(precision, Decisions::fast));
  fast.set_seeds(seeds.view());
  const CellRoom room = room_of(fast.cells());
  const FoundCells before = find_cells(caller, diagram, seeds.view(), room);
  check_whole(before, diagram.domain(), precision);
  check_cells_of(before, fast, seeds.positions);
  if (before.list.empty()) return 0;
  Diagram exact(caller.device(), diagram.domain(), options_in(precision));
  exact.set_seeds(seeds.view());
  FoundCells after = find_cells(caller, diagram, seeds.view(), room, true);
  after.list.clear();
  check_whole(after, diagram.domain(), precision);
  check_cells_of(after, exact, seeds.positions);
  return before.list.size();
}

}  // namespace

TEST_CASE("cells in device memory are those of Diagram, before and after repair") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    std::size_t repaired = 0;
    for (const auto& family : {polygon_domains(), surface_domains(), volume_domains(), box_domains()})
      for (const NamedDomain& domain : family) {
        DeviceDiagram diagram(caller.device(), domain.domain, options_in(precision));
        for (const WeightRange weights : {WeightRange::W0, WeightRange::W2})
          for (const std::size_t n : {2u, 80u}) {
            CAPTURE(domain.name);
            CAPTURE(n);
            CAPTURE(name(weights));
            CAPTURE(static_cast<int>(precision));
            repaired += check_geometry(caller, diagram,
                                       seeds_for(domain.domain, Distribution::white, weights, n, random));
          }
      }
    MESSAGE("precision ", static_cast<int>(precision), ": ", repaired, " cells were repaired");
  }
}

TEST_CASE("cells of periodic domains in device memory are those of Diagram, with shifts") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const NamedDomain& domain : periodic_domains()) {
      DeviceDiagram diagram(caller.device(), domain.domain, options_in(precision));
      for (const std::size_t n : {1u, 3u, 60u}) {
        CAPTURE(domain.name);
        CAPTURE(n);
        CAPTURE(static_cast<int>(precision));
        SeedArray seeds = seeds_for(domain.domain, Distribution::white, WeightRange::W1, n, random);
        const auto periods = domain.domain.periods();
        for (std::size_t i = 0; i < n; i += 2)  // some several periods outside
          for (int c = 0; c < seeds.dimension; ++c)
            seeds.coordinate(i, c) += 2 * periods[0][static_cast<std::size_t>(c)];
        check_geometry(caller, diagram, seeds);
      }
    }
}

TEST_CASE("cells of clusters, of seeds that tie, and of more faces than the first program takes") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const int dimension : {2, 3}) {
      CAPTURE(dimension);
      CAPTURE(static_cast<int>(precision));
      DeviceDiagram diagram(caller.device(), unit_box(dimension), options_in(precision));
      check_geometry(caller, diagram,
                     random_seeds(Distribution::cluster, WeightRange::W1, 300, dimension, random));
      CHECK(check_geometry(caller, diagram, grid(4, dimension)) > 0);
      SeedArray seeds = cospherical(100, dimension);
      for (double& x : seeds.positions) x += random.uniform(-1e-3, 1e-3);
      for (int k = 0; k < dimension; ++k) seeds.positions.push_back(0.5);
      seeds.weights.push_back(0);
      const SeedArray seeds_there = rounded_seeds(seeds, precision);
      const FoundCells found = find_cells(caller, diagram, seeds_there.view(), {200, 9999, 9999, 19999});
      REQUIRE(found.output.status[100] == DeviceSeedStatus::ok);
      CHECK(found.cells.face_offset[found.cells.cell_offset[100] + 1] -
                found.cells.face_offset[found.cells.cell_offset[100]] >
            (dimension == 2 ? 16u : 48u));
      check_geometry(caller, diagram, seeds);
    }
}

TEST_CASE("cells do not depend on the size of launches, bit for bit, nor do measures on cells") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const NamedDomain& domain : one_of_each()) {
    CAPTURE(domain.name);
    const SeedArray exact = seeds_for(domain.domain, Distribution::white, WeightRange::W1, 200, random);
    DeviceDiagram whole(caller.device(), domain.domain);
    const SeedArray seeds = rounded_seeds(exact, whole.precision());
    const CellRoom room{20000, 200000, 200000, 400000};
    const FoundCells expected = find_cells(caller, whole, seeds.view(), room);
    Options options;
    options.chunk_pairs = 37;
    DeviceDiagram parts(caller.device(), domain.domain, options);
    const FoundCells found = find_cells(caller, parts, seeds.view(), room);
    CHECK(found.cells.cell_offset == expected.cells.cell_offset);
    CHECK(found.cells.region == expected.cells.region);
    CHECK(found.cells.vertex_offset == expected.cells.vertex_offset);
    CHECK(found.cells.vertices == expected.cells.vertices);
    CHECK(found.cells.border == expected.cells.border);
    CHECK(found.cells.loop_offset == expected.cells.loop_offset);
    CHECK(found.cells.loop == expected.cells.loop);
    const Output alone = run(caller, whole, seeds.view());
    CHECK(alone.mass == expected.output.mass);
    CHECK(alone.status == expected.output.status);
  }
}

TEST_CASE("cells beyond the caller's room are not written, and the counts say what they need") {
  Caller& caller = shared_caller();
  Random random(1);
  for (const int dimension : {2, 3}) {
    CAPTURE(dimension);
    DeviceDiagram diagram(caller.device(), unit_box(dimension));
    const Precision precision = diagram.precision();
    const SeedArray seeds =
        rounded_seeds(random_seeds(Distribution::white, WeightRange::W2, 200, dimension, random), precision);
    const Job job(caller, precision, seeds.view());
    const CellRoom enough{1000, 20000, 20000, 40000};
    const CellMemory all(caller, precision, diagram.domain(), 200, enough);
    job.enqueue(diagram, {{}, {}, all.handles()});
    const Cells whole = all.read();
    const std::vector<std::uint64_t> counts = all.counts();
    CHECK(counts == std::vector<std::uint64_t>{whole.region.size(),
                                               whole.vertices.size() / static_cast<std::size_t>(dimension),
                                               whole.border.size(), whole.loop.size()});
    CHECK(whole.cell_offset.back() == counts[0]);
    for (std::size_t kind = 0; kind < (dimension == 3 ? 4u : 3u); ++kind) {
      CAPTURE(kind);
      CellRoom room = enough;
      std::size_t& short_one = *std::array{&room.pieces, &room.vertices, &room.faces, &room.loop}[kind];
      short_one = counts[kind] / 2;
      const CellMemory some(caller, precision, diagram.domain(), 200, room);
      job.enqueue(diagram, {{}, {}, some.handles()});
      CHECK(some.counts() == counts);
      CHECK(some.cell_offset() == whole.cell_offset);
      const std::vector<cl_uint> regions = some.regions();
      const auto written = static_cast<std::size_t>(
          std::find(regions.begin(), regions.end(), CellMemory::unwritten) - regions.begin());
      CHECK(written < counts[0]);
      CHECK(written > counts[0] / 4);
      CHECK(std::all_of(regions.begin() + static_cast<std::ptrdiff_t>(written), regions.end(),
                        [](cl_uint r) { return r == CellMemory::unwritten; }));
      const Cells part = some.read(written);
      CHECK(std::equal(part.vertices.begin(), part.vertices.end(), whole.vertices.begin()));
      CHECK(std::equal(part.border.begin(), part.border.end(), whole.border.begin()));
      CHECK(std::equal(part.loop.begin(), part.loop.end(), whole.loop.begin()));
      // The next cell would not have fitted.
      const std::uint64_t next[] = {written + 1, whole.vertex_offset[written + 1],
                                    whole.face_offset[written + 1], 3 * whole.vertex_offset[written + 1]};
      CHECK(next[kind] > short_one);
    }
    if (dimension == 3) continue;
    const List list(caller, 200);
    const CellMemory few(caller, precision, diagram.domain(), 200, {1000, 20000, 9, 0});
    const SeedArray lattice = grid(14, 2);
    const Job ties(caller, precision, lattice.view());
    ties.enqueue(diagram, {{}, list.handles(), few.handles()});
    CHECK_THROWS_WITH_AS(ties.repair(diagram, {{}, list.handles(), few.handles()}),
                         doctest::Contains("room for 1000 pieces, 20000 vertices, 9 faces"), Error);
  }
}

TEST_CASE("cells of no seeds, and of those that are hidden, duplicate, invalid or unfinished") {
  Caller& caller = shared_caller();
  const Domain square = unit_box(2);
  DeviceDiagram diagram(caller.device(), square);
  const Precision precision = diagram.precision();
  const CellMemory none(caller, precision, square, 0, {1, 1, 1, 1});
  diagram.enqueue(nullptr, nullptr, 0, {nullptr, nullptr, {}, {}, none.handles()});
  CHECK(none.counts() == std::vector<std::uint64_t>{0, 0, 0, 0});
  CHECK(none.cell_offset() == std::vector<std::uint64_t>{0});

  const double nan = std::nan("");
  const std::vector<double> positions = {nan, 0.1, 0.25, 0.5, 0.75, 0.5, 0.75, 0.5, 0.3, 0.5};
  const std::vector<double> weights = {0, 0, 0, 0, -1};
  const FoundCells two = find_cells(caller, diagram, {2, positions, weights}, {10, 20, 20, 0});
  CHECK(two.output.status[0] == DeviceSeedStatus::invalid);
  CHECK(two.output.status[3] == DeviceSeedStatus::duplicate);
  CHECK(two.output.status[4] == DeviceSeedStatus::hidden);
  CHECK(two.cells.cell_offset == std::vector<std::uint64_t>{0, 0, 1, 2, 2, 2});
  CHECK(two.cells.vertex_offset == std::vector<std::uint64_t>{0, 4, 8});
  for (const double x : two.cells.vertices) CHECK((x == 0 || x == 0.5 || x == 1));
  // Edges are -y +x +y -x of the square, and one wall.
  for (const std::uint32_t i : {1u, 2u}) {
    std::vector<std::uint32_t> facets, walls;
    for (std::size_t f = 4 * (i - 1); f < 4 * i; ++f)
      (two.cells.border[f].kind == Border::Kind::wall ? walls : facets).push_back(two.cells.border[f].index);
    std::sort(facets.begin(), facets.end());
    CHECK(walls == std::vector<std::uint32_t>{3 - i});
    CHECK(facets == (i == 1 ? std::vector<std::uint32_t>{0, 2, 3} : std::vector<std::uint32_t>{0, 1, 2}));
  }

  SeedArray many = cospherical(300, 2);
  many.push({0.5, 0.5}, 0);
  const FoundCells found = find_cells(caller, diagram, many.view(), {400, 4000, 4000, 0});
  CHECK(found.output.status[300] == DeviceSeedStatus::unfinished);
  CHECK(found.cells.cell_offset[301] == found.cells.cell_offset[300]);
  CHECK(found.cells.cell_offset[301] == 300);
  CHECK(find_cells(caller, diagram, many.view(), {400, 4000, 4000, 0}, true).cells.cell_offset[301] == 301);
}

TEST_CASE("cells of seeds whose pairs exceed their room have no geometry, and the others theirs") {
  Caller& caller = shared_caller();
  Random random(1);
  const Domain domain = Domain::polygon(square_with_holes());
  DeviceDiagram diagram(caller.device(), domain);
  const SeedArray seeds =
      rounded_seeds(random_seeds(Distribution::white, WeightRange::W1, 400, 2, random), diagram.precision());
  const CellRoom room{3000, 30000, 30000, 0};
  const FoundCells all = find_cells(caller, diagram, seeds.view(), room);
  for (const std::uint32_t pairs : {200u, 50000u}) {
    diagram.set_pair_capacity(pairs);
    const FoundCells some = find_cells(caller, diagram, seeds.view(), room);
    CHECK((some.output.count(DeviceSeedStatus::unfinished) > 0) == (pairs == 200));
    check_whole(some, domain, diagram.precision());
    std::size_t different = 0;
    for (std::size_t i = 0; i < 400; ++i)
      different += some.output.status[i] == DeviceSeedStatus::ok && !same_cell(some.cells, all.cells, i, 0);
    CHECK(different == 0);
  }
}

TEST_CASE("buffers of cells that are too small, missing or of another kind of domain are refused") {
  Caller& caller = shared_caller();
  Random random(1);
  DeviceDiagram square(caller.device(), unit_box(2)), cube(caller.device(), unit_box(3));
  const Precision precision = square.precision();
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 20, 2, random);
  const Job job(caller, precision, seeds.view());
  const CellRoom room{100, 1000, 1000, 3000};
  const CellMemory flat(caller, precision, unit_box(2), 20, room),
      small(caller, precision, unit_box(2), 9, room), solid(caller, precision, unit_box(3), 20, room);
  const auto refuses = [&](DeviceCells wrong, const char* message) {
    CHECK_THROWS_WITH_AS(job.enqueue(square, {{}, {}, wrong}), doctest::Contains(message), Error);
  };
  refuses(solid.handles(), "loops in cells of dimension 3 only");
  DeviceCells wrong = flat.handles();
  wrong.cell_offset = small.handles().cell_offset;
  refuses(wrong, "the offsets of cells has 80 bytes; it needs 168");
  wrong = flat.handles();
  wrong.shift = flat.handles().border;
  refuses(wrong, "shifts in periodic domains only");
  for (cl_mem DeviceCells::*member :
       {&DeviceCells::counts, &DeviceCells::region, &DeviceCells::vertex_offset, &DeviceCells::vertices,
        &DeviceCells::face_offset, &DeviceCells::border}) {
    wrong = flat.handles();
    wrong.*member = nullptr;
    refuses(wrong, "is null");
  }
  const SeedArray in_space = random_seeds(Distribution::white, WeightRange::W0, 20, 3, random);
  const Job other(caller, precision, in_space.view());
  wrong = solid.handles();
  wrong.loop = nullptr;
  CHECK_THROWS_WITH_AS(other.enqueue(cube, {{}, {}, wrong}), doctest::Contains("the buffer of loops is null"),
                       Error);
}
