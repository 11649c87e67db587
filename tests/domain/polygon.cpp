#include <doctest/doctest.h>

#include <cmath>

#include "tests/domain/check_mesh.hpp"

namespace powercell {
namespace {

using test::check_mesh;
using test::refusal;

Domain polygon(std::vector<PolygonPart> parts) {
  return Domain::polygon(parts);
}
const Ring square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};

TEST_CASE("a convex ring is one region, whatever its orientation, repeated points and straight vertices") {
  Ring closed = square;
  closed.push_back(closed.front());
  const Ring clockwise(square.rbegin(), square.rend());
  const Ring messy{{2, 0}, {2, 0}, {4, 0}, {4, 1}, {4, 2}, {4, 4}, {4, 4}, {0, 4}, {0, 0}, {1, 0}, {2, 0}};
  for (const Ring& ring : {square, closed, clockwise, messy}) {
    const Domain domain = polygon({{ring, {}}});
    check_mesh(domain);
    CHECK(domain.region_count() == 1);
    CHECK(domain.measure() == 16);
    CHECK(domain.mesh().boundary_count == 4);
    CHECK(domain.kind() == DomainKind::polygon);
    CHECK(domain.dimension() == 2);
    CHECK(domain.cell_dimension() == 2);
  }
}

TEST_CASE("a convex ring of many corners is cut into small pieces") {
  Ring ring;
  const int corners = 1000;
  for (int k = 0; k < corners; ++k) {
    // Points of a parabola are exactly in convex position, unlike rounded points of a circle.
    const double x = k - corners / 2;
    ring.push_back({x, x * x});
  }
  const Domain domain = polygon({{ring, {}}});
  check_mesh(domain);
  CHECK(domain.region_count() <= 64);
  CHECK(domain.mesh().boundary_count == corners);
}

TEST_CASE("a square with a square hole") {
  const Domain domain = polygon({{square, {{{1, 1}, {1, 3}, {3, 3}, {3, 1}}}}});
  check_mesh(domain);
  CHECK(domain.measure() == 12);
  CHECK(domain.mesh().boundary_count == 8);
  CHECK(domain.region_count() >= 3);
  CHECK(domain.region_count() <= 6);
}

TEST_CASE("boundary edges are numbered by part, ring and edge") {
  const Domain domain = polygon({{square, {{{1, 1}, {3, 1}, {3, 3}}}}, {{{5, 0}, {6, 0}, {5, 1}}, {}}});
  check_mesh(domain);
  const RegionMesh& mesh = domain.mesh();
  // Outer edges from (0,0) counter-clockwise; the hole from (1,1) clockwise; then the second part.
  const std::vector<std::array<double, 2>> starts{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1},
                                                  {3, 3}, {3, 1}, {5, 0}, {6, 0}, {5, 1}};
  REQUIRE(mesh.boundary_count == starts.size());
  for (std::size_t slot = 0; slot < mesh.facet.size(); ++slot) {
    if (mesh.facet[slot].kind != Border::Kind::boundary) continue;
    const auto& start = starts[mesh.facet[slot].index];
    CHECK(mesh.vertices[2 * mesh.region_vertex[slot]] == start[0]);
    CHECK(mesh.vertices[2 * mesh.region_vertex[slot] + 1] == start[1]);
  }
  for (std::size_t r = 0; r < mesh.region_count(); ++r) {
    CHECK(mesh.source[r] == (mesh.vertices[2 * mesh.region_vertex[mesh.region_offset[r]]] >= 5 ? 1 : 0));
  }
}

TEST_CASE("holes that touch: at corners, on edges, each other") {
  const Ring at_corner{{0, 0}, {2, 1}, {1, 2}}, on_edge{{2, 0}, {3, 1}, {1, 1}};
  const Ring left{{1, 1}, {2, 2}, {1, 3}}, right{{2, 2}, {3, 1}, {3, 3}};
  const Ring leaning{{2.5, 2}, {3, 1.5}, {3.5, 3}};  // has a corner on an edge of the hole to its left below
  struct Case {
    std::vector<Ring> holes;
    double area;
  };
  for (const Case& c : {Case{{at_corner}, 14.5}, Case{{on_edge}, 15.0}, Case{{left, right}, 14.0},
                        Case{{{{1, 1}, {2.5, 1}, {2.5, 3}}, leaning}, 16 - 1.5 - 0.5}}) {
    const Domain domain = polygon({{square, c.holes}});
    check_mesh(domain);
    CHECK(domain.measure() == doctest::Approx(c.area).epsilon(1e-15));
  }
}

TEST_CASE("parts that touch along edges are joined there, even if their corners differ") {
  const Ring left{{0, 0}, {1, 0}, {1, 2}, {0, 2}};
  const Ring below{{1, 0}, {2, 0}, {2, 1}, {1, 1}}, above{{1, 1}, {2, 1}, {2, 2}, {1, 2}};
  const Domain domain = polygon({{left, {}}, {below, {}}, {above, {}}});
  check_mesh(domain);
  CHECK(domain.measure() == 4);
  CHECK(domain.region_count() == 3);
  // The right edge of `left` is split at (1, 1); no edge between the parts bounds the domain.
  CHECK(domain.mesh().boundary_count == 3 + 2 + 2);
}

TEST_CASE("islands in lakes, and parts that touch in a point") {
  const Ring lake{{1, 1}, {3, 1}, {3, 3}, {1, 3}}, island{{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}};
  const Domain inside = polygon({{square, {lake}}, {island, {}}});
  check_mesh(inside);
  CHECK(inside.measure() == 12.5);
  const Domain filled = polygon({{square, {lake}}, {lake, {}}});
  check_mesh(filled);
  CHECK(filled.measure() == 16);
  CHECK(filled.mesh().boundary_count == 4);
  const Domain corner = polygon({{square, {}}, {{{4, 4}, {5, 4}, {5, 5}}, {}}});
  check_mesh(corner);
  CHECK(corner.mesh().boundary_count == 7);
}

TEST_CASE("polygons of any scale and position") {
  const Ring shape{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};  // an L
  for (const double scale : {0x1p-20, 1.0, 0x1p30}) {
    for (const double offset : {0.0, 0x1p30 * scale, 1e9}) {
      Ring ring = shape;
      for (auto& [x, y] : ring) x = x * scale + offset, y = y * scale - offset;
      const Domain domain = polygon({{ring, {}}});
      CAPTURE(scale);
      CAPTURE(offset);
      check_mesh(domain);
      CHECK(domain.region_count() == 2);
      if (scale * 0x1p50 > offset)
        CHECK(domain.measure() == doctest::Approx(5 * scale * scale).epsilon(1e-9));
    }
  }
}

TEST_CASE("points that rounding moved off a line are not moved back") {
  Ring ring;
  for (int k = 0; k < 60; ++k) ring.push_back({k / 7.0, k / 7.0 * 0.3});
  ring.push_back({-1, 5});
  const Domain domain = polygon({{ring, {}}});
  check_mesh(domain);
  CHECK(domain.mesh().boundary_count >= 3);
}

TEST_CASE("invalid polygons are refused, with the position of the fault") {
  const double nan = std::nan(""), inf = INFINITY;
  CHECK_CONTAINS(refusal([&] { polygon({}); }), "no parts");
  CHECK_CONTAINS(refusal([&] { polygon({{square, {}}, {{}, {}}}); }), "part 1, outer ring");
  CHECK_CONTAINS(refusal([&] { polygon({{{{0, 0}, {1, 1}}, {}}}); }), "three points");
  CHECK_CONTAINS(refusal([&] { polygon({{{{0, 0}, {1, 1}, {3, 3}, {2, 2}}, {}}}); }), "three points");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{{{0, 0}, {1, nan}, {1, 1}}, {}}});
                 }),
                 "part 0, outer ring, point 1");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {{{1, 1}, {2, 1}, {2, inf}}}}});
                 }),
                 "part 0, hole 0, point 2");
  const std::string bow_tie = refusal([&] { polygon({{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}}); });
  CHECK_CONTAINS(bow_tie, "part 0: its outer ring crosses itself at (1, 1)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{{{0, 0}, {4, 0}, {4, 4}, {2, 2}, {4, 4}, {0, 4}}, {}}});
                 }),
                 "part 0: its outer ring runs along itself from (2, 2) to (4, 4)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}, {}}});
                 }),
                 "part 0: its outer ring meets itself at (2, 0)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {{{1, 1}, {2, 2}, {1, 3}}, {{3, 1}, {5, 1}, {5, 2}}}}});
                 }),
                 "part 0: its outer ring and its hole 1 cross at (4, 1)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {{{4, 1}, {4, 2}, {3, 2}}}}});
                 }),
                 "part 0: its outer ring and its hole 0 have an edge in common, from (4, 1) to (4, 2)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {{{5, 5}, {6, 5}, {6, 6}}}}});
                 }),
                 "part 0: its hole 0 lies outside its outer ring, at (5, 5)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {{{1, 1}, {3, 1}, {3, 3}}, {{2, 1.2}, {2.5, 1.2}, {2.5, 1.4}}}}});
                 }),
                 "part 0: its hole 0 and its hole 1 are nested, at (2, 1.2)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {{{0, 1}, {2, 0}, {2, 1}}}}});
                 }),
                 "part 0: its rings touch, the last time at (2, 0), so that they cut it in pieces");
  // The same where the edge of another part lies on the touched one.
  CHECK_CONTAINS(
      refusal([&] {
        polygon({{{{4, 0}, {8, 0}, {8, 4}, {4, 4}}, {}}, {square, {{{0, 2}, {2, 1}, {4, 2}, {2, 3}}}}});
      }),
      "part 1: its rings touch, the last time at (4, 2)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {}}, {{{9, 9}, {10, 9}, {9, 10}}, {}}, {{{1, 1}, {2, 1}, {2, 2}}, {}}});
                 }),
                 "parts 0 and 2 overlap, for instance at (1, 1)");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {}}, {square, {}}});
                 }),
                 "parts 0 and 1 overlap, along their edge from (0, 0) to (");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{square, {}}, {{{3, 1}, {6, 1}, {6, 4}}, {}}});
                 }),
                 "parts 0 and 1 overlap: their edges cross at (4, ");
  // The long edge passes the hole's corner on the wrong side, closer than double precision resolves.
  const Ring wide = {{5.25, 2.375}, {-12.875, -12.75}, {-12.875, -7.75},
                     {-13, -6.25},  {-1.5, 1e30},      {1e30, 1e30}};
  CHECK_CONTAINS(refusal([&] {
                   polygon({{wide, {{{9.125, 6.25}, {5.25, 7.375}, {5, 4.375}}}}});
                 }),
                 "part 0: its outer ring and its hole 0 cross at (");
  CHECK_CONTAINS(refusal([&] { polygon({{{{0, 0}, {1e200, 0}, {1e200, 1e200}}, {}}}); }), "magnitude 1e+200");
  CHECK_CONTAINS(refusal([&] {
                   polygon({{{{0, 0}, {1e-200, 0}, {1e-200, 1e-200}}, {}}});
                 }),
                 "magnitude 1e-200");
}

}  // namespace
}  // namespace powercell
