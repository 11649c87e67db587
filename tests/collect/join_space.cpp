#include <doctest/doctest.h>

#include <algorithm>
#include <map>

#include "tests/collect/cells_by_definition.hpp"
#include "tests/collect/join_laws.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

const SeedArray& middle() {
  static const SeedArray seed = {3, {0.45, 0.5, 0.55}, {0}};
  return seed;
}

}  // namespace

TEST_CASE("one cell over six tetrahedra is the cube") {
  Random random(1);
  const Domain domain = volume_of(cube_tetrahedra(1, 0, random));
  const Cells cells = cells_by_definition(domain, middle().view());
  REQUIRE(cells.piece_count() == 6);
  const JoinedCells joined = join(domain, cells);
  check_join_laws(domain, cells, joined, 1e-15);
  CHECK(JoinedCell(joined, 0).vertex_count() == 8);
  CHECK(JoinedCell(joined, 0).face_count() == 12);  // two boundary facets on each side
  CHECK(interior_count(joined) == 0);
}

TEST_CASE("a wall over several tetrahedra is one polygon") {
  Random random(1);
  const Domain domain = volume_of(cube_tetrahedra(1, 0, random));
  const SeedArray seeds = {3, {0.3, 0.45, 0.55, 0.7, 0.45, 0.55}, {0, 0}};
  const Cells cells = cells_by_definition(domain, seeds.view());
  const JoinedCells joined = join(domain, cells);
  check_join_laws(domain, cells, joined, 1e-15);
  for (std::size_t i = 0; i < 2; ++i) {
    const JoinedCell cell(joined, i);
    const Border wall{Border::Kind::wall, static_cast<std::uint32_t>(1 - i)};
    std::size_t walls = 0;
    for (std::size_t f = 0; f < cell.face_count(); ++f) {
      if (!(joined.face_border[joined.face_offset[i] + f] == wall)) continue;
      ++walls;
      // The corners of the square x = 1/2, and where its sides cross the edges between boundary facets.
      CHECK(cell.corner_count(f) == 8);
    }
    CHECK(walls == 1);
  }
}

TEST_CASE("cells inside a mesh are the convex polyhedra of the diagram of the cube") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 80, 3, random);
  const Domain box = unit_box(3), mesh = volume_of(cube_tetrahedra(2, 0.2, random));
  const Cells whole = cells_by_definition(box, seeds.view());
  const JoinedCells joined = join(mesh, cells_by_definition(mesh, seeds.view()));
  std::size_t inside = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (whole.cell_offset[i] == whole.cell_offset[i + 1]) continue;
    const std::uint64_t p = whole.cell_offset[i];
    const auto begin = whole.border.begin() + static_cast<std::ptrdiff_t>(whole.face_offset[p]);
    const auto end = whole.border.begin() + static_cast<std::ptrdiff_t>(whole.face_offset[p + 1]);
    if (std::any_of(begin, end, [](const Border& b) { return b.kind != Border::Kind::wall; })) continue;
    ++inside;
    const JoinedCell cell(joined, i);
    CHECK(cell.face_count() == static_cast<std::size_t>(end - begin));
    CHECK(cell.vertex_count() == whole.vertex_offset[p + 1] - whole.vertex_offset[p]);
  }
  CHECK(inside > 0);
}

TEST_CASE("joined polyhedra keep the measure and are closed, under the rounding of a device too") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 25, 3, random);
  const Domain cube = volume_of(cube_tetrahedra(2, 0.2, random)), ball = volume_of(ball_tetrahedra(1));
  for (const double noise : {0.0, 1e-14, 3e-7}) {
    INFO("noise " << noise);
    for (const Domain& domain : {cube, ball}) {
      const Cells cells = cells_by_definition(domain, seeds.view(), noise);
      const JoinedCells joined = join(domain, cells);
      check_join_laws(domain, cells, joined, 1e-14 + 50 * noise);
      CHECK(interior_count(joined) == 0);
    }
  }
}

TEST_CASE("one cell over a surface has the vertices of the mesh") {
  for (const Mesh& mesh : {icosphere(2), torus(12, 7), wavy_patch(5), book(4)}) {
    const Domain domain = surface_of(mesh);
    const Cells cells = cells_by_definition(domain, middle().view());
    const JoinedCells joined = join(domain, cells);
    check_join_laws(domain, cells, joined, 1e-13);
    CHECK(JoinedCell(joined, 0).vertex_count() == mesh.vertex_count());
    CHECK(JoinedCell(joined, 0).face_count() == domain.region_count());
  }
}

TEST_CASE("triangles that are oriented against each other share vertices too") {
  Mesh mesh = icosphere(1);
  for (std::size_t t = 0; t < mesh.elements.size(); t += 6) std::swap(mesh.elements[t], mesh.elements[t + 1]);
  const Domain domain = surface_of(mesh);
  const JoinedCells joined = join(domain, cells_by_definition(domain, middle().view()));
  CHECK(JoinedCell(joined, 0).vertex_count() == mesh.vertex_count());
}

TEST_CASE("cells that split a closed surface weld to a surface without gaps") {
  INFO(replay_hint());
  Random random(test_seed());
  const Domain sphere = surface_of(icosphere(2));
  const SeedArray seeds = seeds_for(sphere, Distribution::white, WeightRange::W1, 12, random);
  for (const double noise : {0.0, 1e-14, 3e-7}) {
    INFO("noise " << noise);
    const Cells cells = cells_by_definition(sphere, seeds.view(), noise);
    const JoinedCells joined = join(sphere, cells);
    check_join_laws(sphere, cells, joined, 1e-14 + 50 * noise);
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      // Every interior edge occurs in both directions, every wall and boundary edge in one.
      const JoinedCell cell(joined, i);
      std::map<std::pair<std::uint32_t, std::uint32_t>, Border> edges;
      for (std::size_t f = 0; f < cell.face_count(); ++f)
        for (std::uint64_t k = cell.begin(f); k < cell.end(f); ++k)
          edges[{joined.loop[k], joined.loop[k + 1 < cell.end(f) ? k + 1 : cell.begin(f)]}] =
              joined.edge_border[k];
      for (const auto& [edge, border] : edges)
        CHECK(edges.contains({edge.second, edge.first}) == (border.kind == Border::Kind::interior));
    }
  }
}
