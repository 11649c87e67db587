// The facets of the domain that cells have: against the geometry of the cells, and summed against the facets.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <powercell/error.hpp>
#include <powercell/regions.hpp>

#include "tests/diagram/check.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Point = std::array<double, 3>;

/// The length of an edge or the area of a planar polygon.
double measure_of(const std::vector<Point>& corner) {
  const auto difference = [](const Point& a, const Point& b) {
    return Point{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  };
  Point sum{};
  if (corner.size() == 2) {
    sum = difference(corner[1], corner[0]);
    return std::hypot(sum[0], sum[1], sum[2]);
  }
  for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
    const Point a = difference(corner[k], corner[0]), b = difference(corner[k + 1], corner[0]);
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += (a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3]) / 2;
  }
  return std::hypot(sum[0], sum[1], sum[2]);
}

Point point_at(std::span<const double> coordinates, int dimension, std::uint64_t v) {
  Point point{};
  for (int c = 0; c < dimension; ++c)
    point[static_cast<std::size_t>(c)] =
        coordinates[v * static_cast<std::uint64_t>(dimension) + static_cast<std::uint64_t>(c)];
  return point;
}

using Facets = std::map<std::uint32_t, double>;

/// Of the faces of a cell.
Facets facets_of(const Cells& cells, std::size_t i) {
  Facets facets;
  for (std::uint64_t p = cells.cell_offset[i]; p < cells.cell_offset[i + 1]; ++p) {
    const std::uint64_t first = cells.vertex_offset[p], count = cells.vertex_offset[p + 1] - first;
    for (std::uint64_t f = cells.face_offset[p]; f < cells.face_offset[p + 1]; ++f) {
      if (cells.border[f].kind != Border::Kind::boundary) continue;
      std::vector<Point> corner;
      if (cells.cell_dimension == 2) {
        const std::uint64_t k = f - cells.face_offset[p];
        corner = {point_at(cells.vertices, cells.dimension, first + k),
                  point_at(cells.vertices, cells.dimension, first + (k + 1) % count)};
      } else {
        for (std::uint64_t l = cells.loop_offset[f]; l < cells.loop_offset[f + 1]; ++l)
          corner.push_back(point_at(cells.vertices, 3, first + cells.loop[l]));
      }
      facets[cells.border[f].index] += measure_of(corner);
    }
  }
  return facets;
}

Facets row_of(const BoundaryWalls& walls, std::size_t i) {
  Facets facets;
  for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k) {
    const bool is_new = facets.insert({walls.facet[k], walls.measure[k]}).second;
    CHECK(is_new);
    CHECK(walls.measure[k] > 0);
  }
  return facets;
}

void check_same(const Facets& a, const Facets& b, double error) {
  const auto at = [](const Facets& facets, std::uint32_t f) {
    const auto found = facets.find(f);
    return found == facets.end() ? 0 : found->second;
  };
  for (const auto& [facet, measure] : a) CHECK(std::abs(measure - at(b, facet)) <= error);
  for (const auto& [facet, measure] : b) CHECK(std::abs(measure - at(a, facet)) <= error);
}

/// The boundary facets of a domain by its regions.
Facets facets_of(const Domain& domain) {
  constexpr std::array<std::array<int, 4>, 6> box{
      {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
  const RegionsView regions = domain.regions();
  Facets facets;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const std::uint32_t first = regions.region_offset[r], count = regions.region_offset[r + 1] - first;
    for (std::uint32_t f = regions.facet_offset[r]; f < regions.facet_offset[r + 1]; ++f) {
      if (regions.facet[f].kind != Border::Kind::boundary) continue;
      const std::uint32_t k = f - regions.facet_offset[r];
      std::vector<Point> corner;
      const auto add = [&](std::uint32_t v) {
        corner.push_back(point_at(regions.vertices, regions.dimension, regions.region_vertex[first + v]));
      };
      if (regions.shape == RegionShape::box) {
        for (const int v : box[k]) add(static_cast<std::uint32_t>(v));
      } else if (regions.shape == RegionShape::tetrahedron) {
        for (std::uint32_t v = 0; v < 4; ++v)
          if (v != k) add(v);
      } else {
        add(k);
        add((k + 1) % count);
      }
      facets[regions.facet[f].index] += measure_of(corner);
    }
  }
  return facets;
}

Facets sum(const BoundaryWalls& walls) {
  Facets facets;
  for (std::size_t k = 0; k < walls.facet.size(); ++k) facets[walls.facet[k]] += walls.measure[k];
  return facets;
}

std::vector<NamedDomain> domains_with_boundary() {
  const std::array<bool, 2> along_x{true, false};
  return {{"islands", Domain::polygon(islands())},
          {"square", unit_box(2)},
          {"patch", surface_of(wavy_patch(5))},
          {"ball", volume_of(ball_tetrahedra(0))},
          {"box3", unit_box(3)},
          {"strip", Domain::periodic_box(std::array{0.0, 0.0}, std::array{1.0, 0.5}, along_x)}};
}

}  // namespace

TEST_CASE("facets: those of the cells' geometry, and together the domain's") {
  INFO(replay_hint());
  for (const NamedDomain& named : domains_with_boundary())
    for (const Setup& setup : all_setups())
      for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
        INFO(named.name << ", " << setup.name);
        Random random(test_seed());
        const SeedArray seeds = seeds_for(named.domain, Distribution::white, range, 200, random);
        Diagram diagram(setup.device, named.domain, setup.options);
        diagram.set_seeds(seeds.view());
        const double error = setup.options.precision == Precision::float32 ? 1e-4 : 1e-11;
        const BoundaryWalls& walls = diagram.boundary_walls();
        REQUIRE(walls.offset.size() == seeds.size() + 1);
        for (std::size_t i = 0; i < seeds.size(); ++i)
          check_same(row_of(walls, i), facets_of(diagram.cells(), i), error);
        if (!named.domain.is_periodic()) check_same(sum(walls), facets_of(named.domain), 10 * error);
        const std::vector<std::uint32_t> selected{17, 3, 101};
        const BoundaryWalls all = walls;
        diagram.select(selected);
        for (std::size_t k = 0; k < selected.size(); ++k)
          check_same(row_of(diagram.boundary_walls(), k), row_of(all, selected[k]), error);
      }
}

TEST_CASE("facets: a periodic strip has its bounded sides, closed domains have none") {
  const Setup& setup = main_setups().front();
  Random random(test_seed());
  for (const NamedDomain& named : {NamedDomain{"strip", domains_with_boundary().back().domain},
                                   NamedDomain{"torus", surface_of(torus(12, 7))},
                                   NamedDomain{"lattice", Domain::lattice(std::array{1.0, 0.0, 0.2, 0.8})}}) {
    INFO(named.name);
    const SeedArray seeds = seeds_for(named.domain, Distribution::white, WeightRange::W1, 100, random);
    Diagram diagram(setup.device, named.domain, setup.options);
    diagram.set_seeds(seeds.view());
    const Facets facets = sum(diagram.boundary_walls());
    if (named.name != "strip") {
      CHECK(facets.empty());
      continue;
    }
    REQUIRE(facets.size() == 2);
    for (const auto& [facet, length] : facets) CHECK(std::abs(length - 1) < 1e-12);
  }
}

TEST_CASE("facets: a bisector in a side of the domain leaves the side to the cell inside") {
  for (const Setup& setup : main_setups()) {
    INFO(setup.name);
    const SeedArray seeds{2, {0.25, 0.5, -0.25, 0.5}, {0, 0}};
    Diagram diagram(setup.device, unit_box(2), setup.options);
    diagram.set_seeds(seeds.view());
    check_same(row_of(diagram.boundary_walls(), 0), facets_of(unit_box(2)), 1e-12);
    CHECK(row_of(diagram.boundary_walls(), 1).empty());
  }
}

TEST_CASE("facets: of a solid, those of its tetrahedra") {
  const Setup& setup = main_setups().front();
  if (setup.options.precision == Precision::float32) return;
  Random random(test_seed());
  const Mesh surface = icosphere(1);
  const Domain solid = Domain::solid(surface.vertices, surface.elements),
               ball = volume_of(ball_tetrahedra(1));
  const SeedArray seeds = seeds_for(ball, Distribution::white, WeightRange::W1, 100, random);
  Diagram here(setup.device, solid, setup.options), there(setup.device, ball, setup.options);
  here.set_seeds(seeds.view());
  there.set_seeds(seeds.view());
  const auto of_cell = [](const BoundaryWalls& walls, std::size_t i) {
    double sum = 0;
    for (const auto& [facet, measure] : row_of(walls, i)) sum += measure;
    return sum;
  };
  for (std::size_t i = 0; i < seeds.size(); ++i)
    CHECK(std::abs(of_cell(here.boundary_walls(), i) - of_cell(there.boundary_walls(), i)) < 1e-11);
  CHECK(sum(here.boundary_walls()).size() == surface.elements.size() / 3);
}
