#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "lib/domain/region_mesh.hpp"
#include "tests/collect/cells_by_definition.hpp"
#include "tests/collect/join_laws.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// A polygon domain of these convex regions; edges between the same two vertices are interior.
Domain regions(std::vector<double> vertices, const std::vector<std::vector<std::uint32_t>>& rings) {
  auto mesh = std::make_shared<RegionMesh>();
  mesh->dimension = mesh->cell_dimension = 2;
  mesh->vertices = std::move(vertices);
  mesh->high = {1, 1, 0};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> region_of;  // by directed edge
  const auto edge = [](const auto& ring, std::size_t k) {
    return std::pair{ring[k], ring[(k + 1) % ring.size()]};
  };
  for (std::uint32_t r = 0; r < rings.size(); ++r)
    for (std::size_t k = 0; k < rings[r].size(); ++k) region_of[edge(rings[r], k)] = r;
  mesh->region_offset = {0};
  for (const auto& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const auto [a, b] = edge(ring, k);
      const auto behind = region_of.find({b, a});
      if (behind == region_of.end()) {
        mesh->facet.push_back({Border::Kind::boundary, mesh->boundary_count++});
      } else {
        mesh->facet.push_back({Border::Kind::interior, behind->second});
      }
      mesh->region_vertex.push_back(a);
    }
    mesh->region_offset.push_back(static_cast<std::uint32_t>(mesh->region_vertex.size()));
    mesh->source.push_back(0);
  }
  mesh->facet_offset = mesh->region_offset;
  return Domain(mesh);
}

Domain square_of_two_triangles() {
  return regions({0, 0, 1, 0, 1, 1, 0, 1}, {{0, 1, 2}, {0, 2, 3}});
}

/// The unit square around the square [1/4, 3/4]^2, as four trapezia.
Domain frame() {
  return regions({0, 0, 1, 0, 1, 1, 0, 1, .25, .25, .75, .25, .75, .75, .25, .75},
                 {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// A fan of triangles about an inner point.
Domain fan(double x, double y) {
  return regions({0, 0, 1, 0, 1, 1, 0, 1, x, y}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

}  // namespace

TEST_CASE("a cell over two regions is one ring without the edge between them") {
  const std::vector<double> positions = {0.5, 0.5};
  const SeedsView one{2, positions, {}};
  for (const Domain& domain : {square_of_two_triangles(), fan(0.5, 0.5), fan(0.3, 0.6)}) {
    const Cells cells = cells_by_definition(domain, one);
    const JoinedCells joined = join(domain, cells);
    check_join_laws(domain, cells, joined, 1e-15);
    REQUIRE(JoinedCell(joined, 0).face_count() == 1);
    CHECK(JoinedCell(joined, 0).corner_count(0) == 4);
    for (const Border& border : joined.edge_border) CHECK(border.kind == Border::Kind::boundary);
  }
}

TEST_CASE("a wall split by regions becomes one edge") {
  const std::vector<double> positions = {0.2, 0.4, 0.8, 0.4};  // the wall x = 1/2 crosses the diagonal
  const SeedsView two{2, positions, {}};
  const Domain domain = square_of_two_triangles();
  const Cells cells = cells_by_definition(domain, two);
  const JoinedCells joined = join(domain, cells);
  check_join_laws(domain, cells, joined, 1e-15);
  for (std::size_t i = 0; i < 2; ++i) {
    REQUIRE(JoinedCell(joined, i).face_count() == 1);
    CHECK(JoinedCell(joined, i).corner_count(0) == 4);
    const auto begin = joined.edge_border.begin() + static_cast<std::ptrdiff_t>(4 * i);
    const Border wall{Border::Kind::wall, static_cast<std::uint32_t>(1 - i)};
    CHECK(std::count(begin, begin + 4, wall) == 1);
  }
}

TEST_CASE("a cell around a hole has an outer ring and a clockwise one") {
  const std::vector<double> positions = {0.5, 0.5};
  const SeedsView one{2, positions, {}};
  const Cells cells = cells_by_definition(frame(), one);
  const JoinedCells joined = join(frame(), cells);
  check_join_laws(frame(), cells, joined, 1e-15);
  const JoinedCell cell(joined, 0);
  REQUIRE(cell.face_count() == 2);
  CHECK(std::max(cell.ring_area(0), cell.ring_area(1)) == doctest::Approx(1));
  CHECK(std::min(cell.ring_area(0), cell.ring_area(1)) == doctest::Approx(-0.25));
}

TEST_CASE("a cell in two parts has two outer rings") {
  // The middle seed's cell is the strip .4 < x < .6, which the hole divides.
  const std::vector<double> positions = {0.3, 0.5, 0.5, 0.5, 0.7, 0.5};
  const SeedsView three{2, positions, {}};
  const Cells cells = cells_by_definition(frame(), three);
  const JoinedCells joined = join(frame(), cells);
  check_join_laws(frame(), cells, joined, 1e-15);
  const JoinedCell cell(joined, 1);
  REQUIRE(cell.face_count() == 2);
  for (std::size_t f = 0; f < 2; ++f) {
    CHECK(cell.ring_area(f) == doctest::Approx(0.05));
    CHECK(cell.corner_count(f) == 4);
  }
}

TEST_CASE("parts and holes that touch in a vertex stay separate") {
  // Of six triangles around the middle vertex two opposite ones are missing: two touching parts, two gaps.
  const Domain bow =
      regions({0, 0, 1, 0, 1, 1, 0, 1, .5, .5, 0, .5, 1, .5}, {{0, 4, 5}, {5, 4, 3}, {1, 6, 4}, {6, 2, 4}});
  const std::vector<double> positions = {0.5, 0.5};
  const SeedsView one{2, positions, {}};
  const Cells cells = cells_by_definition(bow, one);
  const JoinedCells joined = join(bow, cells);
  check_join_laws(bow, cells, joined, 1e-15);
  const JoinedCell cell(joined, 0);
  REQUIRE(cell.face_count() == 2);
  CHECK(cell.ring_area(0) == doctest::Approx(0.25));
  CHECK(cell.ring_area(1) == doctest::Approx(0.25));
}

TEST_CASE("a hole that touches the outer ring is a ring of its own") {
  // The triangle (1, 7, 6) is missing in a square; it meets the square's rim in vertex 1 only.
  const Domain domain =
      regions({0, 0, .5, 0, 1, 0, 1, 1, 0, 1, .5, .8, .7, .5, .3, .5},
              {{0, 1, 7}, {0, 7, 4}, {7, 5, 4}, {7, 6, 5}, {5, 3, 4}, {6, 3, 5}, {2, 3, 6}, {1, 2, 6}});
  const std::vector<double> positions = {0.5, 0.5};
  const SeedsView one{2, positions, {}};
  const Cells cells = cells_by_definition(domain, one);
  const JoinedCells joined = join(domain, cells);
  check_join_laws(domain, cells, joined, 1e-15);
  const JoinedCell cell(joined, 0);
  REQUIRE(cell.face_count() == 2);
  CHECK(std::max(cell.ring_area(0), cell.ring_area(1)) == doctest::Approx(1));
  CHECK(std::min(cell.ring_area(0), cell.ring_area(1)) == doctest::Approx(-0.1));
}

TEST_CASE("a region too thin for a piece leaves no gap") {
  const double x = 0.5, y = x + 1e-16;
  const Domain domain =
      regions({0, 0, x, 0, y, 0, 1, 0, 1, 1, y, 1, x, 1, 0, 1}, {{0, 1, 6, 7}, {1, 2, 5, 6}, {2, 3, 4, 5}});
  const std::vector<double> positions = {0.5, 0.2, 0.5, 0.8};
  const SeedsView two{2, positions, {}};
  const Cells cells = cells_by_definition(domain, two);
  REQUIRE(cells.piece_count() == 4);  // of two cells in three regions: the middle one is flat
  const JoinedCells joined = join(domain, cells);
  check_join_laws(domain, cells, joined, 1e-15);
  CHECK(interior_count(joined) == 0);
  CHECK(JoinedCell(joined, 0).face_count() == 1);
}

TEST_CASE("joined polygons keep the measure, exactly and under the rounding of a device") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 40, 2, random);
  for (const double noise : {0.0, 1e-14, 3e-7}) {
    INFO("noise " << noise);
    for (const Domain& domain : {square_of_two_triangles(), frame(), fan(0.5, 0.5), fan(0.31, 0.62)}) {
      const Cells cells = cells_by_definition(domain, seeds.view(), noise);
      const JoinedCells joined = join(domain, cells);
      check_join_laws(domain, cells, joined, 1e-15 + 20 * noise);
      CHECK(interior_count(joined) == 0);
    }
  }
}

TEST_CASE("cells of another kind of domain are refused") {
  const std::vector<double> positions = {0.5, 0.5};
  const Cells cells = cells_by_definition(unit_box(2), SeedsView{2, positions, {}});
  CHECK_THROWS_AS(join(unit_box(3), cells), Error);
}
