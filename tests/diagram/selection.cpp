// Cells of some seeds, with the diagram of all seeds as the oracle.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <powercell/density.hpp>
#include <powercell/error.hpp>
#include <powercell/log.hpp>
#include <powercell/verify.hpp>
#include <utility>

#include "tests/diagram/check.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Selected = std::vector<std::uint32_t>;

double tolerance(const Setup& setup) {
  return setup.options.precision == Precision::float32 ? 1e-4 : 1e-11;
}

bool close(double a, double b, double error) {
  return std::abs(a - b) <= error || (std::isnan(a) && std::isnan(b));
}

void check_measures(const Measures& all, const Measures& some, const Selected& selected, double relative) {
  const auto d = static_cast<std::size_t>(all.dimension);
  REQUIRE(some.mass.size() == selected.size());
  REQUIRE(some.status.size() == selected.size());
  REQUIRE(some.centroid.size() == selected.size() * d);
  const double error = relative * all.domain_measure;
  for (std::size_t k = 0; k < selected.size(); ++k) {
    const std::size_t i = selected[k];
    CAPTURE(i);
    CHECK(some.status[k] == all.status[i]);
    CHECK(close(some.mass[k], all.mass[i], error));
    CHECK(close(some.second_moment[k], all.second_moment[i], 10 * error));
    for (std::size_t c = 0; c < d; ++c)  // a first moment is known to rounding, a centroid is not
      CHECK(close(some.centroid[k * d + c] * all.mass[i], all.centroid[i * d + c] * all.mass[i], 10 * error));
  }
}

using Neighbor = std::pair<std::uint32_t, std::array<std::int32_t, 3>>;

std::map<Neighbor, double> walls_of(const Adjacency& adjacency, std::size_t row) {
  std::map<Neighbor, double> walls;
  for (std::uint64_t k = adjacency.offset[row]; k < adjacency.offset[row + 1]; ++k) {
    const auto shift = adjacency.shift.empty() ? std::array<std::int32_t, 3>{} : adjacency.shift[k];
    const bool is_new = walls.insert({{adjacency.neighbor[k], shift}, adjacency.wall[k]}).second;
    CHECK(is_new);
  }
  return walls;
}

/// Both have the same walls, except that each may lack some of measures within the error.
void check_walls(const std::map<Neighbor, double>& a, const std::map<Neighbor, double>& b, double error) {
  const auto measure_in = [](const std::map<Neighbor, double>& walls, const Neighbor& neighbor) {
    const auto found = walls.find(neighbor);
    return found == walls.end() ? 0 : found->second;
  };
  for (const auto& [neighbor, wall] : a) CHECK(close(wall, measure_in(b, neighbor), error));
  for (const auto& [neighbor, wall] : b) CHECK(close(wall, measure_in(a, neighbor), error));
}

void check_adjacency(const Adjacency& all, const Adjacency& some, const Selected& selected, double error) {
  REQUIRE(some.offset.size() == selected.size() + 1);
  CHECK(std::is_sorted(some.offset.begin(), some.offset.end()));
  for (std::size_t k = 0; k < selected.size(); ++k) {
    CAPTURE(selected[k]);
    for (std::uint64_t w = some.offset[k]; w + 1 < some.offset[k + 1]; ++w)
      CHECK(some.neighbor[w] <= some.neighbor[w + 1]);
    check_walls(walls_of(all, selected[k]), walls_of(some, k), error);
  }
}

/// The number of pieces and the mean vertex of a cell.
std::array<double, 4> outline(const Cells& cells, std::size_t i) {
  const auto d = static_cast<std::size_t>(cells.dimension);
  const std::uint64_t first = cells.vertex_offset[cells.cell_offset[i]],
                      last = cells.vertex_offset[cells.cell_offset[i + 1]];
  std::array<double, 4> sum{static_cast<double>(cells.cell_offset[i + 1] - cells.cell_offset[i])};
  for (std::uint64_t v = first; v < last; ++v)
    for (std::size_t c = 0; c < d; ++c)
      sum[1 + c] += cells.vertices[v * d + c] / static_cast<double>(last - first);
  return sum;
}

void check_cells(const Cells& all, const Cells& some, const Selected& selected, double error) {
  REQUIRE(some.cell_count() == selected.size());
  for (std::size_t k = 0; k < selected.size(); ++k) {
    CAPTURE(selected[k]);
    const auto a = outline(all, selected[k]), b = outline(some, k);
    for (std::size_t c = 0; c < 4; ++c) CHECK(close(a[c], b[c], error));
  }
}

/// A share of the seeds, shuffled.
Selected random_selection(std::size_t count, double share, Random& random) {
  Selected selected;
  for (std::uint32_t i = 0; i < count; ++i)
    if (random.uniform() < share) selected.push_back(i);
  for (std::size_t k = selected.size(); k > 1; --k) std::swap(selected[k - 1], selected[random.index(k)]);
  return selected;
}

void check_selection(Diagram& all, Diagram& some, const Selected& selected, double relative) {
  CAPTURE(selected.size());
  some.select(selected);
  const double size = std::max(1.0, all.measures().domain_measure);
  check_measures(all.measures(), some.measures(), selected, relative);
  check_adjacency(all.adjacency(), some.adjacency(), selected, 100 * relative * size);
  if (!all.domain().is_solid()) check_cells(all.cells(), some.cells(), selected, 1e3 * relative * size);
}

std::vector<NamedDomain> a_domain_of_each_kind() {
  const Mesh ball = icosphere(1);
  return {{"islands", Domain::polygon(islands())},
          {"square", unit_box(2)},
          {"torus", surface_of(torus(12, 7))},
          {"ball", volume_of(ball_tetrahedra(0))},
          {"box3", unit_box(3)},
          {"solid", Domain::solid(ball.vertices, ball.elements)},
          {"periodic square", Domain::periodic_box(std::array{0.0, 0.0}, std::array{1.0, 1.0})},
          {"lattice", Domain::lattice(std::array{1.0, 0.0, 0.0, 0.3, 1.1, 0.0, -0.2, 0.1, 0.9})}};
}

bool works(const NamedDomain& named, const Setup& setup) {
  return !named.domain.is_solid() ||
         (setup.options.precision != Precision::float32 && setup.options.neighbors != Neighbors::flann);
}

}  // namespace

TEST_CASE("selection: the cells of some seeds are those of the diagram of all") {
  INFO(replay_hint());
  for (const NamedDomain& named : a_domain_of_each_kind())
    for (const Setup& setup : all_setups()) {
      if (!works(named, setup)) continue;
      INFO(named.name << ", " << setup.name);
      Random random(test_seed());
      for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
        const SeedArray seeds = seeds_for(named.domain, Distribution::white, range, 400, random);
        Diagram all(setup.device, named.domain, setup.options),
            some(setup.device, named.domain, setup.options);
        all.set_seeds(seeds.view());
        some.set_seeds(seeds.view());
        for (const double share : {0.0, 0.01, 0.2, 1.0})
          check_selection(all, some, random_selection(seeds.size(), share, random), tolerance(setup));
        some.select_all();
        CHECK(some.measures().mass == all.measures().mass);
        CHECK(some.adjacency().neighbor == all.adjacency().neighbor);
      }
    }
}

TEST_CASE("selection: cells of a periodic domain that reach beyond the first images") {
  INFO(replay_hint());
  const Domain cube = Domain::periodic_box(std::array{0.0, 0.0, 0.0}, std::array{1.0, 1.0, 1.0},
                                           std::array{true, true, false});
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    Random random(test_seed());
    const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W1, 600, 3, random);
    Diagram all(setup.device, cube, setup.options), some(setup.device, cube, setup.options),
        geometry_first(setup.device, cube, setup.options);
    for (Diagram* const diagram : {&all, &some, &geometry_first}) diagram->set_seeds(seeds.view());
    std::size_t widened = 0;
    set_log([&](LogLevel, std::string_view line) {
      widened += line.find("reached beyond") != std::string_view::npos;
    });
    check_selection(all, some, random_selection(seeds.size(), 0.3, random), tolerance(setup));
    geometry_first.cells();
    set_log({});
    CHECK(widened >= 3);
    Selected every(seeds.size());
    std::iota(every.begin(), every.end(), 0U);
    check_cells(all.cells(), geometry_first.cells(), every, 1e3 * tolerance(setup));
    CHECK(all.adjacency().neighbor == geometry_first.adjacency().neighbor);
  }
}

TEST_CASE("selection: goes with new weights, and ends with new seeds") {
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W1, 500, 3, random);
    Diagram all(setup.device, unit_box(3), setup.options), some(setup.device, unit_box(3), setup.options);
    all.set_seeds(seeds.view());
    some.set_seeds(seeds.view());
    const Selected selected = random_selection(seeds.size(), 0.1, random);
    some.select(selected);
    some.measures();
    set_weights(seeds, WeightRange::W2, spacing(1, seeds.size(), 3), random);
    all.set_weights(seeds.weights);
    some.set_weights(seeds.weights);
    check_measures(all.measures(), some.measures(), selected, tolerance(setup));
    some.set_seeds(seeds.view());
    CHECK(some.measures().mass.size() == seeds.size());
  }
}

TEST_CASE("selection: duplicates, hidden seeds, ties") {
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    SeedArray seeds = grid(5, 3);
    seeds.push({seeds.coordinate(7, 0), seeds.coordinate(7, 1), seeds.coordinate(7, 2)}, -1);  // a duplicate
    seeds.push({0.5, 0.5, 0.51}, -10);                                                         // hidden
    Diagram all(setup.device, unit_box(3), setup.options), some(setup.device, unit_box(3), setup.options);
    all.set_seeds(seeds.view());
    some.set_seeds(seeds.view());
    check_selection(all, some, {126, 3, 125, 7, 62}, tolerance(setup));
    CHECK(some.measures().status == std::vector{SeedStatus::hidden, SeedStatus::ok, SeedStatus::duplicate,
                                                SeedStatus::ok, SeedStatus::ok});
  }
}

TEST_CASE("selection: what is refused") {
  const Setup& setup = main_setups().front();
  const auto code_of = [](auto&& call) {
    try {
      call();
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::internal;
  };
  Diagram diagram(setup.device, unit_box(2), setup.options);
  CHECK(code_of([&] { diagram.select(Selected{0}); }) == ErrorCode::invalid_argument);
  const SeedArray seeds = grid(3, 2);
  diagram.set_seeds(seeds.view());
  diagram.select(Selected{4, 2});
  CHECK(code_of([&] { diagram.select(Selected{0, 9}); }) == ErrorCode::invalid_argument);
  CHECK(code_of([&] { diagram.select(Selected{1, 2, 1}); }) == ErrorCode::invalid_argument);
  CHECK(diagram.measures().mass.size() == 2);  // the selection before is still there
  CHECK(code_of([&] { diagram.dual(); }) == ErrorCode::unsupported);
  CHECK(code_of([&] { verify(diagram, seeds.view()); }) == ErrorCode::unsupported);
  CHECK(code_of([&] { integrate(diagram, Density::constant(1), false); }) == ErrorCode::unsupported);
  Options options = setup.options;
  options.certify = true;
  Diagram certified(setup.device, unit_box(2), options);
  certified.set_seeds(seeds.view());
  CHECK(code_of([&] { certified.select(Selected{0}); }) == ErrorCode::unsupported);
}

TEST_CASE("selection: a wall with a neighbour whose cell is flat is one with the cell behind it") {
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    for (const int dimension : {2, 3})
      for (const double place : {0.375, 0.5, 0.625}) {
        SeedArray seeds{dimension, {}, {}};
        const auto add = [&](double x, double weight) {
          seeds.positions.push_back(x);
          seeds.positions.insert(seeds.positions.end(), static_cast<std::size_t>(dimension - 1), 0.5);
          seeds.weights.push_back(weight);
        };
        add(0.25, 0);
        add(0.75, 0);
        add(place,
            (place - 0.5) * (place - 0.5) - 0.0625);  // beyond both bisectors but for the plane x = 1/2
        Diagram all(setup.device, unit_box(dimension), setup.options),
            some(setup.device, unit_box(dimension), setup.options);
        all.set_seeds(seeds.view());
        some.set_seeds(seeds.view());
        REQUIRE(all.measures().status[2] == SeedStatus::hidden);
        check_selection(all, some, {0}, tolerance(setup));
        check_selection(all, some, {2, 1}, tolerance(setup));
      }
  }
}
