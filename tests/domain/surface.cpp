#include <doctest/doctest.h>

#include <cmath>
#include <powercell/shapes.hpp>

#include "tests/domain/check_mesh.hpp"

namespace powercell {
namespace {

using test::refusal;
using Indices = std::vector<std::uint32_t>;

Domain surface(const std::vector<double>& vertices, const Indices& triangles) {
  return Domain::surface(vertices, triangles);
}
const std::vector<double> four_corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};

TEST_CASE("a closed surface has no boundary, an open one numbers its edges in order") {
  const Domain closed = surface(four_corners, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
  test::check_mesh(closed);
  CHECK(closed.measure() == doctest::Approx(1.5 + std::sqrt(3.0) / 2).epsilon(1e-15));
  CHECK(closed.mesh().boundary_count == 0);
  CHECK(closed.kind() == DomainKind::surface);
  CHECK(closed.dimension() == 3);
  CHECK(closed.cell_dimension() == 2);

  const Domain open = surface(four_corners, {0, 2, 1, 0, 1, 3});
  test::check_mesh(open);
  using Kind = Border::Kind;
  CHECK(open.mesh().facet == std::vector<Border>{{Kind::boundary, 0},
                                                 {Kind::boundary, 1},
                                                 {Kind::interior, 1},
                                                 {Kind::interior, 0},
                                                 {Kind::boundary, 2},
                                                 {Kind::boundary, 3}});
}

TEST_CASE("triangles of any orientation are adjacent, also by repeated vertices") {
  const Domain flipped = surface(four_corners, {0, 2, 1, 0, 3, 1});
  test::check_mesh(flipped);
  CHECK(flipped.mesh().boundary_count == 4);

  std::vector<double> doubled = four_corners;
  doubled.insert(doubled.end(), {-0.0, 0, 0, 1, 0, -0.0});
  const Domain soup = surface(doubled, {0, 2, 1, 4, 5, 3});
  test::check_mesh(soup);
  CHECK(soup.mesh().boundary_count == 4);
  CHECK(soup.mesh().region_vertex == Indices{0, 2, 1, 4, 5, 3});  // the vertices themselves stay
}

TEST_CASE("each triangle at an edge of many has the next one behind the edge") {
  std::vector<double> fan{0, 0, 0, 0, 0, 1};
  Indices triangles;
  for (std::uint32_t k = 0; k < 5; ++k) {
    fan.insert(fan.end(), {std::cos(1.1 * k), std::sin(1.1 * k), 0});
    triangles.insert(triangles.end(), {0, 1, 2 + k});
  }
  const Domain domain = surface(fan, triangles);
  test::check_mesh(domain);
  for (std::uint32_t k = 0; k < 5; ++k) {
    CHECK(domain.mesh().facet[3 * k] == Border{Border::Kind::interior, (k + 1) % 5});
  }
  CHECK(domain.mesh().boundary_count == 10);
}

TEST_CASE("flat triangles are left out, slivers are kept, at any scale") {
  std::vector<double> v = four_corners;
  v.insert(v.end(), {0.5, 0, 0, 0.5, 1e-9, 0, 0.1, 0.1, 0.1, 0.3, 0.3, 0.3, 0.7, 0.7, 0.7});
  const Domain domain = surface(v, {0, 1, 1, 0, 1, 4, 0, 1, 5, 6, 7, 8, 0, 2, 1});
  test::check_mesh(domain);
  CHECK(domain.mesh().source == Indices{2, 4});
  CHECK(domain.measure() == doctest::Approx(0.5 + 0.5e-9).epsilon(1e-15));
  // The threshold is relative to the size of the triangle.
  for (const double scale : {1e-100, 1e-6, 1e9}) {
    std::vector<double> small = four_corners;
    for (double& x : small) x *= scale;
    const Domain scaled = surface(small, {0, 1, 2});
    CHECK(scaled.measure() == doctest::Approx(scale * scale / 2).epsilon(1e-15));
  }
}

TEST_CASE("invalid surfaces are refused, with the index of the element") {
  CHECK_CONTAINS(refusal([] { surface({}, {}); }), "has no triangles");
  CHECK_CONTAINS(refusal([] { surface(four_corners, {0, 1}); }), "3 vertex indices each, got 2");
  CHECK_CONTAINS(refusal([] { surface({0, 0}, {0, 1, 2}); }), "3 coordinates each, got 2");
  CHECK_CONTAINS(refusal([] { surface(four_corners, {0, 1, 2, 0, 1, 4}); }), "triangle 1: vertex index 4");
  std::vector<double> broken = four_corners;
  broken[7] = std::nan("");
  CHECK_CONTAINS(refusal([&] { surface(broken, {0, 1, 3}); }), "vertex 2: coordinate y is nan");
  broken[7] = INFINITY;
  CHECK_CONTAINS(refusal([&] { surface(broken, {0, 1, 3}); }), "vertex 2: coordinate y is inf");
  CHECK_CONTAINS(refusal([] { surface(four_corners, {0, 1, 1, 2, 2, 2}); }), "all 2 triangles are flat");
}

TEST_CASE("a million triangles") {
  const TriangleMesh mesh = sphere(224);
  const Domain domain = Domain::surface(mesh.vertices, mesh.triangles);
  CHECK(domain.region_count() == 20 * 224 * 224);
  CHECK(domain.mesh().boundary_count == 0);
  CHECK(domain.measure() == doctest::Approx(4 * 3.14159265358979).epsilon(1e-5));
}

}  // namespace
}  // namespace powercell
