// Seeds with ties everywhere: lattices plain, tilted, tiny, huge and far from the origin, and spheres. The
// cells of a lattice are known, and its dual must be a triangulation.
#include "tests/exact/lattices.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>
#include <set>

#include "tests/exact/check_triangulation.hpp"
#include "tests/support/compare.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

Options options_for(Precision precision) {
  Options options;
  options.precision = precision;
  return options;
}

void check_walls(const Adjacency& adjacency) {
  CHECK(std::ranges::all_of(adjacency.wall, [](double wall) { return wall > 0; }));
  const Differences differences = check_symmetric(adjacency);
  CHECK_MESSAGE(differences.empty(), summary(differences));
}

long double hull_measure(const Lattice& lattice, const Place& place) {
  // The hull of a lattice of one seed per period; it lacks the last layer.
  const long double side =
      place.scale * static_cast<long double>(lattice.k - 1) / static_cast<long double>(lattice.k);
  return std::pow(side, static_cast<long double>(lattice.dimension));
}

}  // namespace

TEST_CASE("lattices in all placements: cells, neighbours and dual") {
  for (const Lattice& lattice : lattices())
    for (const Place& place : places)
      for (const Precision precision : {Precision::float64, Precision::float32}) {
        if (precision == Precision::float32 && place.name != "plain" && place.name != "huge") continue;
        const std::string label =
            lattice.name + " " + place.name + (precision == Precision::float32 ? " float" : " double");
        CAPTURE(label);
        const LatticeSeeds seeds = lattice_seeds(lattice, place);
        Diagram diagram(test_device(), box_around(place, lattice.dimension), options_for(precision));
        diagram.set_seeds(seeds.array.view());
        diagram.compute(true, true);
        const Measures& measures = diagram.measures();
        const double cell = std::pow(place.scale / static_cast<double>(lattice.k), lattice.dimension) /
                            static_cast<double>(lattice.basis.size());
        const bool single = precision == Precision::float32;
        // Far from the origin or tilted, rounding moves positions off the exact lattice.
        const double rounding =
            4e-16 * (1 + place.offset / place.scale) * static_cast<double>(lattice.k) * 30;
        const double tolerance = (single ? 1e-5 : 1e-12) + rounding;
        CHECK(diagram.timings().uncertain > 0);
        CHECK(measures.relative_error() < (single ? 1e-6 : 1e-14));
        CHECK(measures.count(SeedStatus::ok) == seeds.array.size());
        const Adjacency& adjacency = diagram.adjacency();
        check_walls(adjacency);
        for (std::size_t i = 0; i < seeds.array.size(); ++i) {
          if (!seeds.inside[i]) continue;
          CHECK(measures.mass[i] / cell == doctest::Approx(1).epsilon(tolerance));
          // With exact positions, the neighbours are exact.
          if (place.angle == 0 && place.name != "tiny" && (lattice.k & (lattice.k - 1)) == 0)
            CHECK(adjacency.offset[i + 1] - adjacency.offset[i] == lattice.neighbors);
        }
        const Triangulated triangulated = check_triangulation(diagram.dual(), seeds.array);
        CHECK(triangulated.faults == 0);
        const long double measure = triangulated.measure;
        if (lattice.basis.size() == 1)
          CHECK(static_cast<double>(measure / hull_measure(lattice, place)) ==
                doctest::Approx(1).epsilon(1e-9));
      }
}

TEST_CASE("all seeds on a circle or sphere") {
  for (const int dimension : {2, 3})
    for (const Precision precision : {Precision::float64, Precision::float32}) {
      CAPTURE(dimension);
      // The points are exact: integers (x, y, z) with x^2 + y^2 + z^2 = r^2.
      const long radius = dimension == 2 ? 5525 : 45;
      SeedArray seeds;
      seeds.dimension = dimension;
      const long depth = dimension == 3 ? radius : 0;
      for (long x = -radius; x <= radius; ++x)
        for (long y = -radius; y <= radius; ++y) {
          const long rest = radius * radius - x * x - y * y;
          if (rest < 0) continue;
          const long z = std::lround(std::sqrt(static_cast<double>(rest)));
          if (z * z != rest || z > depth) continue;
          for (const long sign : {-1L, 1L}) {
            if (z == 0 && sign > 0) continue;
            seeds.positions.push_back(static_cast<double>(x));
            seeds.positions.push_back(static_cast<double>(y));
            if (dimension == 3) seeds.positions.push_back(static_cast<double>(sign * z));
            seeds.weights.push_back(0);
          }
        }
      CAPTURE(seeds.size());
      REQUIRE(seeds.size() > 60);
      const double half = 4.0 * static_cast<double>(radius);
      const std::vector<double> low(static_cast<std::size_t>(dimension), -half),
          high(static_cast<std::size_t>(dimension), half);
      Diagram diagram(test_device(), Domain::box(low, high), options_for(precision));
      diagram.set_seeds(seeds.view());
      diagram.compute(true, true);
      CHECK(diagram.measures().relative_error() < (precision == Precision::float32 ? 1e-6 : 1e-14));
      check_walls(diagram.adjacency());
      // All vertices of cells coincide in the centre, so the dual is a triangulation of the hull of the
      // seeds.
      CHECK(check_triangulation(diagram.dual(), seeds).faults == 0);
      CHECK(diagram.dual().size() >= seeds.size() - static_cast<std::size_t>(dimension));
      std::set<std::uint32_t> used(diagram.dual().simplices.begin(), diagram.dual().simplices.end());
      CHECK(used.size() == seeds.size());
    }
}

TEST_CASE("fast decisions count ties but leave none to the host") {
  const LatticeSeeds seeds = lattice_seeds(lattices()[1], places[0]);
  Options options = options_for(Precision::automatic);
  options.decisions = Decisions::fast;
  Diagram diagram(test_device(), box_around(places[0], 3), options);
  diagram.set_seeds(seeds.array.view());
  diagram.measures();
  CHECK(diagram.timings().uncertain > 0);
  CHECK(diagram.timings().on_host == 0);
}
