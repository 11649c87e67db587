// Unrestricted cells in domains of many regions, which are clipped in one piece and then classified as
// inside, outside or unclear.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/diagram.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

Measures measures_of(const Setup& setup, const Domain& domain, const SeedArray& seeds) {
  Diagram diagram(setup.device, domain, setup.options);
  diagram.set_seeds(seeds.view());
  return diagram.measures();
}

double tolerance(const Setup& setup) {
  return setup.options.precision == Precision::float32 ? 2e-5 : 1e-12;
}

/// The unit square as strips, each a part of its own.
Domain strips(int count) {
  std::vector<PolygonPart> parts;
  for (int k = 0; k < count; ++k) {
    const double a = static_cast<double>(k) / count, b = static_cast<double>(k + 1) / count;
    parts.push_back({{{a, 0}, {b, 0}, {b, 1}, {a, 1}}, {}});
  }
  return Domain::polygon(parts);
}

/// Jittered grid points in a box, fine enough that most cells meet no boundary.
SeedArray dense(int dimension, int per_axis, double low, double high, Random& random) {
  SeedArray seeds;
  seeds.dimension = dimension;
  const double step = (high - low) / per_axis;
  const int count = dimension == 3 ? per_axis * per_axis * per_axis : per_axis * per_axis;
  for (int k = 0; k < count; ++k) {
    const int at[3] = {k % per_axis, k / per_axis % per_axis, k / per_axis / per_axis};
    for (int c = 0; c < dimension; ++c)
      seeds.positions.push_back(low + step * (at[c] + 0.5 + random.uniform(-0.3, 0.3)));
    seeds.weights.push_back(random.uniform(0, 0.2 * step * step));
  }
  return seeds;
}

}  // namespace

TEST_CASE("unrestricted cells: those in a hole are hidden, those around it keep their measure") {
  INFO(replay_hint());
  Random random(test_seed());
  const Ring hole = {{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}, {0.8, 0.2}};
  const Domain domain = Domain::polygon(std::vector<PolygonPart>{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {hole}}});
  const SeedArray seeds = dense(2, 40, 0, 1, random);
  for (const Setup& setup : main_setups()) {
    const Measures measures = measures_of(setup, domain, seeds);
    CHECK(std::abs(sum(measures.mass) - 0.64) <= tolerance(setup));
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      const double x = seeds.coordinate(i, 0), y = seeds.coordinate(i, 1);
      const double in = std::min({x - 0.2, 0.8 - x, y - 0.2, 0.8 - y});
      CAPTURE(i);
      if (in > 0.08) CHECK(measures.status[i] == SeedStatus::hidden);
      if (in < -0.08) CHECK(measures.status[i] == SeedStatus::ok);
    }
  }
}

TEST_CASE("unrestricted cells: where meshes overlap, cells count once in each") {
  INFO(replay_hint());
  Random random(test_seed());
  const Mesh one = cube_tetrahedra(3, 0.1, random);
  Mesh both = one, other = one;
  for (double& x : other.vertices) x = 0.5 + 0.009 * x;  // larger overlaps are refused
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const std::uint32_t v : other.elements)
    both.elements.push_back(v + static_cast<std::uint32_t>(one.vertex_count()));
  SeedArray seeds = dense(3, 14, 0, 1.4, random);
  seeds.push({0.502, 0.503, 0.504}, 0);
  seeds.push({0.506, 0.503, 0.502}, 0);
  for (const Setup& setup : main_setups()) {
    const Measures a = measures_of(setup, volume_of(one), seeds),
                   b = measures_of(setup, volume_of(other), seeds);
    const Measures ab = measures_of(setup, volume_of(both), seeds);
    CHECK(std::abs(sum(ab.mass) - 1 - std::pow(0.009, 3)) <= tolerance(setup));
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      CAPTURE(i);
      REQUIRE(std::abs(ab.mass[i] - a.mass[i] - b.mass[i]) <= tolerance(setup) / 100);
    }
  }
}

TEST_CASE("unrestricted cells: cells too thin to be classified are clipped region by region") {
  // Rows of seeds 1e-13 apart: the cells between them are thinner than the rounding of the domain's
  // coordinates.
  SeedArray seeds;
  seeds.dimension = 2;
  for (int row = 0; row < 20; ++row)
    for (int k = 0; k < 20; ++k) seeds.push({0.5 + 1e-13 * k, (row + 0.5) / 20}, 0);
  const Domain domain = strips(7);
  REQUIRE(domain.region_count() == 7);
  for (const Setup& setup : main_setups()) {
    if (setup.options.precision == Precision::float32)
      continue;  // two floats do not represent positions 1e-13 apart
    const Measures measures = measures_of(setup, domain, seeds);
    CHECK(std::abs(sum(measures.mass) - 1) <= 1e-12);
    for (int row = 0; row < 20; ++row)  // the outer two seeds of a row share nearly all of it
      CHECK(std::abs(measures.mass[static_cast<std::size_t>(row) * 20] - 0.5 / 20) <= 1e-6);
  }
}

TEST_CASE(
    "unrestricted cells: facets in grid planes through seeds and centroids do not leave cells unclear") {
  const Domain domain = volume_of([] {
    Random still(1);
    return cube_tetrahedra(4, 0, still);
  }());
  SeedArray grid;
  grid.dimension = 3;
  for (int k = 0; k < 16 * 16 * 16; ++k)
    grid.push({(k % 16 + 0.5) / 16, (k / 16 % 16 + 0.5) / 16, (k / 256 + 0.5) / 16}, 0);
  for (const Setup& setup : main_setups()) {
    const Measures measures = measures_of(setup, domain, grid);
    for (const double mass : measures.mass) REQUIRE(std::abs(mass * 4096 - 1) <= 100 * tolerance(setup));
  }
}

TEST_CASE("unrestricted cells: a cell far from its seed keeps its mass") {
  // The Voronoi cells of a cross of seven seeds y, as the power cells of seeds y + t with weights 2 t.y.
  // Relative to such seeds, second moment and centroid determine a cell's size badly.
  const Domain domain = volume_of(ball_tetrahedra(1));
  const double arm = 0.3125, directions[3] = {825.2275390625, -702.692138671875, 719.823486328125};
  for (const double far : {0x1p-6, 0x1p-3, 1.0, 8.0}) {
    SeedArray seeds;
    for (int j = 0; j < 7; ++j) {
      double y[3] = {0, 0, 0};
      if (j > 0) y[(j - 1) / 2] = j % 2 ? -arm : arm;
      double weight = 0;
      for (int k = 0; k < 3; ++k) weight += 2 * far * directions[k] * y[k];
      seeds.push({y[0] + far * directions[0], y[1] + far * directions[1], y[2] + far * directions[2]},
                 weight);
    }
    for (const Setup& setup : all_setups()) {
      INFO(setup.name << ", " << far);
      const Measures measures = measures_of(setup, domain, seeds);
      CHECK(measures.status[0] == SeedStatus::ok);
      CHECK(measures.mass[0] == doctest::Approx(arm * arm * arm).epsilon(0.01));
    }
  }
}
