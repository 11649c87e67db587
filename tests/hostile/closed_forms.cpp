// Inputs that must work, against the closed form for seeds on a line: in a bar around the line the cells are
// slices, on every kind of domain, and follow from the power distances on the line.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <powercell/diagram.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Line {
  std::vector<double> x, w;
};

/// The bar [origin, origin + size]^d as one kind of domain; its axis is the middle line along x.
struct Bar {
  const char* name;
  Domain domain;
};

double placed(double unit, double origin, double size) {
  return origin + size * unit;
}

std::vector<Bar> bars(double origin, double size) {
  const auto move = [&](std::vector<double>& all) {
    for (double& x : all) x = placed(x, origin, size);
  };
  Parts square = unit_square();
  for (auto& point : square[0].outer)
    for (double& x : point) x = placed(x, origin, size);
  Mesh plate;  // in the plane z = 1/2, with the second triangle inverted
  plate.vertices = {0, 0, 0.5, 1, 0, 0.5, 1, 1, 0.5, 0, 1, 0.5};
  plate.elements = {0, 1, 2, 0, 3, 2};
  Random random(7);
  Mesh solid = cube_tetrahedra(2, 0.1, random);  // every other tetrahedron is inverted
  move(plate.vertices);
  move(solid.vertices);
  const std::vector<double> low(3, placed(0, origin, size)), high(3, placed(1, origin, size));
  return {{"polygon", Domain::polygon(square)},
          {"surface", surface_of(plate)},
          {"tetrahedra", volume_of(solid)},
          {"box2", Domain::box(std::span(low).first(2), std::span(high).first(2))},
          {"box3", Domain::box(low, high)}};
}

/// The fraction of [0, 1] that each seed owns, by definition. Of seeds at one position the heaviest, then the
/// first, owns all.
std::vector<double> slices(const Line& line) {
  std::vector<double> mass;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    long double low = 0, high = 1;
    for (std::size_t j = 0; j < line.x.size(); ++j) {
      if (j == i) continue;
      const long double q = static_cast<long double>(line.x[j]) - line.x[i];
      const long double dw = static_cast<long double>(line.w[i]) - line.w[j];
      if (q == 0) {
        if (dw < 0 || (dw == 0 && j < i)) high = -1;
        continue;
      }
      const long double wall = line.x[i] + (q + dw / q) / 2;
      if (q > 0)
        high = std::min(high, wall);
      else
        low = std::max(low, wall);
    }
    mass.push_back(static_cast<double>(std::max(high - low, 0.0L)));
  }
  return mass;
}

/// A bound for how far rounding moves the walls in the bar, in units of the bar.
double wall_error(const Line& line, double unit) {
  double most = unit;
  for (std::size_t i = 0; i < line.x.size(); ++i)
    for (std::size_t j = 0; j < line.x.size(); ++j) {
      const double q = std::fabs(line.x[j] - line.x[i]);
      if (q == 0) continue;
      const double far = std::max(std::fabs(line.x[i]), std::fabs(1 - line.x[i])) + 1;
      const double lift = std::fabs(line.w[i] - line.w[j]) / q;
      if (std::fabs(q - lift) / 2 <= far + 1) most = std::max(most, unit * (far + q + lift));
    }
  return 64 * most;
}

/// Computes the line in a bar and compares masses, statuses and the walls between the slices.
void check_line(const Setup& setup, const Bar& bar, const Line& line, double origin, double size) {
  INFO(setup.name << ", " << bar.name << ", origin " << origin << ", size " << size);
  const int d = bar.domain.dimension();
  SeedArray seeds{d, {}, {}};
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    seeds.positions.push_back(placed(line.x[i], origin, size));
    for (int k = 1; k < d; ++k) seeds.positions.push_back(placed(0.5, origin, size));
    seeds.weights.push_back(line.w[i] * size * size);
  }
  Diagram diagram(setup.device, bar.domain, setup.options);
  diagram.set_seeds(seeds.view());
  const Measures& measures = diagram.measures();
  const double unit = unit_roundoff(diagram.precision());
  const double tolerance = wall_error(line, unit) + 16 * 0x1p-53 * std::fabs(origin) / size;
  REQUIRE(tolerance < 0.02);  // otherwise the test would check nothing
  const std::vector<double> expected = slices(line);
  REQUIRE(measures.mass.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    CHECK(std::fabs(measures.mass[i] / bar.domain.measure() - expected[i]) <= 2 * tolerance);
    if (expected[i] > 2 * tolerance) CHECK(measures.status[i] == SeedStatus::ok);
    if (expected[i] == 0) CHECK(measures.status[i] != SeedStatus::ok);
  }
  if (expected.empty()) CHECK(measures.total() == 0);
  // Adjacent slices share one wall across the bar.
  const auto wide =
      std::count_if(expected.begin(), expected.end(), [&](double m) { return m > 4 * tolerance; });
  const auto slivers =
      std::count_if(expected.begin(), expected.end(), [&](double m) { return m > 0; }) - wide;
  if (slivers > 0) return;
  const Adjacency& adjacency = diagram.adjacency();
  CHECK(adjacency.neighbor.size() == static_cast<std::size_t>(2 * std::max<std::ptrdiff_t>(wide - 1, 0)));
  const double across = bar.domain.cell_dimension() == 3 ? size * size : size;
  for (const double wall : adjacency.wall) CHECK(std::fabs(wall / across - 1) <= 1e3 * unit + tolerance);
}

void check_everywhere(const Line& line) {
  // Powers of two, so that seeds and weights are scaled without rounding.
  constexpr std::pair<double, double> kPlaces[] = {{0, 1}, {0, 0x1p-20}, {-0x1p30, 0x1p30}, {0x1p13, 1}};
  for (const auto& [origin, size] : kPlaces)
    for (const Bar& bar : bars(origin, size))
      for (const Setup& setup : all_setups()) check_line(setup, bar, line, origin, size);
}

}  // namespace

TEST_CASE("no seed, one, two, and fewer than a search expects") {
  check_everywhere({{}, {}});
  check_everywhere({{0.25}, {0}});
  check_everywhere({{-3}, {-7}});
  check_everywhere({{0.25, 0.5}, {0, 0.125}});
  check_everywhere({{0.125, 0.375, 0.875}, {0.0625, 0, 0.125}});
}

TEST_CASE("all seeds equal, or all at one position with different weights") {
  check_everywhere({std::vector<double>(30, 0.75), std::vector<double>(30, 0.5)});
  Line line{std::vector<double>(30, 0.25), {}};
  for (int i = 0; i < 30; ++i) line.w.push_back(i * 7 % 30);
  check_everywhere(line);
  line.x.push_back(1);
  line.w.push_back(29);
  check_everywhere(line);
}

TEST_CASE("weights that hide all but one, and one a million times the others") {
  Line line;
  for (int i = 0; i < 16; ++i) {
    line.x.push_back((i + 0.5) / 16);
    line.w.push_back(1e-6 * (i % 3));
  }
  line.w[9] = 2;
  check_everywhere(line);
  line.w[9] = 1e-6 * 1e6 / 64;  // its cell extends an eighth of the bar to either side
  check_everywhere(line);
  line.x[9] = -2;  // outside the bar, with a cell in it
  line.w[9] = 6;
  check_everywhere(line);
}

TEST_CASE("a constant added to all weights") {
  Line line;
  for (int i = 0; i < 16; ++i) {
    line.x.push_back((i + 0.5) / 16);
    line.w.push_back((i * 5 % 16) * 0x1p-12);
  }
  const Line plain = line;
  for (const double shift : {-3.0, 0x1p20, -0x1p30}) {
    line.w = plain.w;
    for (double& w : line.w) w += shift;  // without rounding
    CHECK(slices(line) == slices(plain));
    check_everywhere(line);
  }
}

// Seeds 4, 7, 10 and 13 have slices of width 0: the bisectors of three seeds coincide, and the wall is
// between the two others.
TEST_CASE("slices of width 0") {
  Line line;
  for (int i = 0; i < 16; ++i) {
    line.x.push_back((i + 0.5) / 16);
    line.w.push_back((i * 5 % 16) * 0x1p-11 - 3);
  }
  for (const Bar& bar : bars(0, 1))
    for (const Setup& setup : all_setups()) check_line(setup, bar, line, 0, 1);
}

TEST_CASE("clusters over six orders of magnitude") {
  Line line;
  for (int k = 0; k <= 6; ++k)
    for (const double x : {1.0, 2.0, 5.0}) {
      line.x.push_back(0.1 * x * std::pow(0.1, k));
      line.w.push_back(0);
    }
  for (const Bar& bar : bars(0, 1))
    for (const Setup& setup : all_setups()) check_line(setup, bar, line, 0, 1);
}

TEST_CASE("seeds far outside, on one side and on both") {
  for (const double far : {10.0, 1e3}) {
    check_everywhere({{-far, -far - 1}, {0, 2 * far + 0.5}});
    check_everywhere({{-far, 0.25, far + 1}, {0, 0, 0}});
  }
  for (const Bar& bar : bars(0, 1))
    for (const Setup& setup : all_setups()) {
      if (setup.options.precision == Precision::float32) continue;  // the rounding is a tenth of the bar
      check_line(setup, bar, {{-1e6, 1e6 + 1, 0.5}, {0, 0, -2.5e11}}, 0, 1);
    }
}

TEST_CASE("seeds at the ends, on the faces and edges of the bar, and 0 beside -0") {
  check_everywhere({{0, 1, 0.5, -0.0}, {0, 0, 0, 0.25}});
  Random random(test_seed());
  for (const Bar& bar : bars(0, 1))
    for (const Setup& setup : all_setups()) {
      INFO(setup.name << ", " << bar.name);
      const int d = bar.domain.dimension();
      SeedArray seeds{d, {}, {}};
      for (int corner = 0; corner < (d == 2 ? 4 : 8); ++corner)
        for (int k = 0; k < d; ++k) seeds.positions.push_back(corner >> k & 1);
      seeds.weights.assign(seeds.size(), 0.0);
      Diagram diagram(setup.device, bar.domain, setup.options);
      diagram.set_seeds(seeds.view());
      // Quarters of a square, eighths of a cube; the plate lies in the walls between the corners below and
      // above it.
      const bool plate = bar.domain.kind() == DomainKind::surface;
      if (plate) continue;
      for (const double mass : diagram.measures().mass)
        CHECK(std::fabs(mass * static_cast<double>(seeds.size()) - 1) <
              1e3 * unit_roundoff(diagram.precision()));
    }
}
