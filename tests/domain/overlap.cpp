// Elements that are given twice or overlap: left out, reported or refused.
#include "lib/domain/overlap.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <powercell/shapes.hpp>

#include "tests/domain/check_mesh.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/meshes.hpp"
#include "tests/support/polytope.hpp"

namespace powercell {
namespace {

using Indices = std::vector<std::uint32_t>;
using test::Mesh;
using test::Random;
using test::refusal;

/// A mesh with another one appended, its vertices moved.
Mesh both(Mesh a, const Mesh& b, std::array<double, 3> shift = {0, 0, 0}) {
  const auto first = static_cast<std::uint32_t>(a.vertex_count());
  for (std::size_t k = 0; k < b.vertices.size(); ++k) a.vertices.push_back(b.vertices[k] + shift[k % 3]);
  for (const std::uint32_t v : b.elements) a.elements.push_back(first + v);
  return a;
}

/// Rotates about an axis in no special position, so that planes are exact no more.
void turn(Mesh& mesh) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (std::size_t k = 0; k < mesh.vertices.size(); k += 3) {
    double *x = &mesh.vertices[k], *y = x + 1, *z = x + 2;
    for (const auto& [u, v] : {std::pair{x, y}, {y, z}, {z, x}}) {
      const double turned = c * *u - s * *v;
      *v = s * *u + c * *v;
      *u = turned;
    }
  }
}

Domain surface(const Mesh& mesh) {
  return Domain::surface(mesh.vertices, mesh.elements);
}
Domain volume(const Mesh& mesh) {
  return Domain::volume(mesh.vertices, mesh.elements);
}

Mesh cube(int per_axis, double jitter = 0) {
  Random random(test::test_seed());
  return test::cube_tetrahedra(per_axis, jitter, random);
}

/// n x n squares of the plane z = 0 in two triangles each, along one diagonal or the other.
Mesh sheet(std::uint32_t n, bool other_diagonal = false) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      mesh.vertices.insert(mesh.vertices.end(), {i / double(n), j / double(n), 0});
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1, c = b + 1, d = a + 1;
      const Indices two = other_diagonal ? Indices{a, b, d, b, c, d} : Indices{a, b, c, a, c, d};
      mesh.elements.insert(mesh.elements.end(), two.begin(), two.end());
    }
  return mesh;
}

/// The measure of the common part of two elements, by half-spaces.
double common(const Mesh& mesh, std::size_t i, std::size_t j, std::size_t corners) {
  const auto at = [&](std::size_t element, std::size_t c) {
    const double* x = &mesh.vertices[3 * std::size_t{mesh.elements[corners * element + c]}];
    return test::Vec{x[0], x[1], x[2]};
  };
  if (corners == 3) {
    test::Polygon part{{at(i, 0), at(i, 1), at(i, 2)}, std::vector<Border>(3)};
    const test::Vec n = cross(at(j, 1) - at(j, 0), at(j, 2) - at(j, 0));
    for (std::size_t c = 0; c < 3 && !part.empty(); ++c) {
      const test::Vec out = cross(at(j, (c + 1) % 3) - at(j, c), n);
      part = clip(part, {out, dot(out, at(j, c))}, {});
    }
    return part.empty() ? 0 : static_cast<double>(test::moments(part).measure);
  }
  test::Polyhedron part{{at(i, 0), at(i, 1), at(i, 2), at(i, 3)}, {}};
  const bool positive = dot(at(i, 1) - at(i, 0), cross(at(i, 2) - at(i, 0), at(i, 3) - at(i, 0))) > 0;
  for (const auto& f : tetrahedron_facet)
    part.faces.push_back({positive ? Indices{f[0], f[1], f[2]} : Indices{f[0], f[2], f[1]}, {}});
  for (std::size_t c = 0; c < 4 && !part.empty(); ++c) {
    const test::Vec p = at(j, (c + 1) % 4), n = cross(at(j, (c + 2) % 4) - p, at(j, (c + 3) % 4) - p);
    const test::Vec out = dot(n, at(j, c) - p) > 0 ? test::Real{-1} * n : n;
    part = clip(part, {out, dot(out, p)}, {});
  }
  return part.empty() ? 0 : static_cast<double>(test::moments(part).measure);
}

}  // namespace

TEST_CASE("a triangle given twice counts once, in any order of its corners") {
  Mesh ball = test::icosphere(2);
  const std::size_t n = ball.elements.size() / 3;
  const double area = surface(ball).measure();
  Mesh doubled = ball;
  for (std::size_t t = 0; t < n; ++t)
    for (const std::size_t c : {t % 3, (t + 2) % 3, (t + 1) % 3})
      doubled.elements.push_back(ball.elements[3 * t + c]);
  for (const Mesh& mesh : {doubled, both(ball, ball), both(doubled, ball)}) {
    const Domain domain = surface(mesh);
    test::check_mesh(domain);
    CHECK(domain.measure() == area);
    CHECK(domain.mesh().boundary_count == 0);
    CHECK(domain.report().repeated.size() == mesh.elements.size() / 3 - n);
    CHECK(domain.report().repeated[0] == std::array{static_cast<std::uint32_t>(n), 0u});
    CHECK(domain.report().overlaps == 0);
    CHECK_CONTAINS(domain.notes().at(0), "triangles given twice");
  }
  CHECK(surface(ball).report().empty());
}

TEST_CASE("a tetrahedron given twice counts once") {
  const Mesh solid = cube(3, 0.2);
  const Domain once = volume(solid), twice = volume(both(solid, solid));
  test::check_mesh(twice);
  CHECK(twice.measure() == once.measure());
  CHECK(twice.mesh().facet == once.mesh().facet);
  CHECK(twice.report().repeated.size() == 6 * 27);
  CHECK(once.report().empty());
  // The first of them is kept; also beside a flat one and others at the same facet.
  const std::vector<double> corners{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const Domain few = Domain::volume(
      corners, Indices{0, 1, 1, 2, 0, 1, 2, 3, 1, 2, 3, 4, 3, 2, 1, 0, 1, 0, 2, 3, 4, 3, 2, 1});
  test::check_mesh(few);
  CHECK(few.mesh().source == Indices{1, 2});
  CHECK(few.report().flat == Indices{0});
  CHECK(few.report().repeated == std::vector<std::array<std::uint32_t, 2>>{{3, 1}, {4, 1}, {5, 2}});
  CHECK(few.notes().size() == 2);
}

TEST_CASE("solids that overlap are refused, with the place; solids that touch are not") {
  const Mesh solid = cube(2);
  const std::string deep = refusal([&] { volume(both(solid, solid, {0.5, 0.1, 0.1})); });
  CHECK_CONTAINS(deep, "overlap around (");
  CHECK_CONTAINS(deep, "of the volume would count twice");
  for (const double depth : {0.3, 1e-2, 1e-5})
    CHECK_CONTAINS(refusal([&] { volume(both(solid, solid, {1 - depth, 0.3, -0.7})); }), " overlap around (");
  // Inside one tetrahedron, without any contact.
  Mesh small = cube(1);
  for (double& x : small.vertices) x = 0.3 + 0.02 * x;
  CHECK_CONTAINS(refusal([&] { volume(both(solid, small)); }), " overlap around (0.3");
  // In touch along a face, an edge, at a corner, with another triangulation of the face.
  for (const std::array<double, 3>& shift :
       {std::array{1.0, 0.0, 0.0}, {1.0, 0.25, -0.1}, {1, 1, 0.3}, {1, 1, 1}})
    for (const bool turned : {false, true}) {
      Mesh mesh = both(solid, cube(3), shift);
      if (turned) turn(mesh);
      const Domain domain = volume(mesh);
      CHECK(domain.measure() == doctest::Approx(2).epsilon(1e-12));
      CHECK(domain.report().empty());
    }
}

TEST_CASE("overlaps of less than a millionth of the volume are reported") {
  const Mesh solid = cube(2);
  const Domain domain = volume(both(solid, solid, {1 - 0x1p-30, 0, 0}));
  CHECK(domain.report().overlap == doctest::Approx(0x1p-30).epsilon(1e-4));
  CHECK(domain.report().largest.at[0] == doctest::Approx(1));
  CHECK_CONTAINS(domain.notes().at(0), "pairs of tetrahedra overlap");
}

TEST_CASE("a fold of a conforming mesh is an overlap") {
  // The wedge of a disc around an axis that turns by more than a full turn.
  Mesh fan{{0, 0, 0, 0, 0, 1}, {}};
  for (std::uint32_t k = 0; k < 12; ++k) {
    fan.vertices.insert(fan.vertices.end(), {std::cos(0.6 * k), std::sin(0.6 * k), 0.5});
    if (k > 0) fan.elements.insert(fan.elements.end(), {0, 1, 1 + k, 2 + k});
  }
  CHECK_CONTAINS(refusal([&] { volume(fan); }), "overlap around");
  fan.elements.resize(4 * 10);
  CHECK(volume(fan).report().empty());
}

TEST_CASE("triangles that overlap in a plane are reported, those that meet or cross are not") {
  const Mesh plane = sheet(6);
  Mesh crossing = plane;
  for (std::size_t k = 0; k < crossing.vertices.size(); k += 3) {
    crossing.vertices[k + 2] = crossing.vertices[k] - 0.4;
  }
  for (const bool turned : {false, true}) {
    const auto found = [&](Mesh mesh) {
      if (turned) turn(mesh);
      return surface(mesh).report();
    };
    CHECK(found(plane).empty());
    CHECK(found(both(plane, plane, {1, 0.01, 0})).empty());
    CHECK(found(both(plane, plane, {0, 0, 1e-9})).empty());
    CHECK(found(both(plane, crossing)).empty());
    const MeshReport whole = found(both(plane, sheet(6, true)));
    CHECK(whole.overlap == doctest::Approx(1).epsilon(1e-9));  // of every square all four parts are open
    const MeshReport part = found(both(plane, sheet(1), {0.75, 0.75, 0}));
    CHECK(part.overlaps > 0);
    CHECK(part.overlap <= 1.0 / 16 * (1 + 1e-9));
  }
  // A flap turned down onto its neighbour: a fold.
  const Domain fold = Domain::surface(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0.5, 0.25, 0},
                                      Indices{0, 1, 2, 0, 1, 3});
  CHECK(fold.report().overlap == doctest::Approx(0.125));
  CHECK_CONTAINS(fold.notes().at(0), "pair of triangles overlaps and counts twice 0.2 of the area");
}

TEST_CASE("among random elements exactly the pairs that overlap are found") {
  Random random(test::test_seed());
  INFO(test::replay_hint());
  for (const std::size_t corners : {3, 4}) {
    Mesh soup;
    // Far larger than the others together, so that a volume is not refused.
    soup.vertices = {-900, -900, -1000, 900, 0, -1000, 0, 900, -1000, 0, 0, -50};
    soup.elements = corners == 3 ? Indices{0, 1, 2} : Indices{0, 1, 2, 3};
    for (std::uint32_t k = 0; k < 150; ++k) {
      const double x = random.uniform(), y = random.uniform(), z = random.uniform();
      const int level = static_cast<int>(random.index(4));
      for (std::size_t c = 0; c < corners; ++c) {
        soup.elements.push_back(static_cast<std::uint32_t>(soup.vertex_count()));
        const double u = x + 0.4 * random.uniform(), v = y + 0.4 * random.uniform();
        // Triangles in four planes in no special position.
        const double w = corners == 3 ? 0.3 * u - 0.7 * v + level : z + 0.4 * random.uniform();
        soup.vertices.insert(soup.vertices.end(), {u, v, w});
      }
    }
    const MeshReport found = corners == 3 ? surface(soup).report() : volume(soup).report();
    std::size_t overlaps = 0;
    double sum = 0;
    for (std::size_t i = 1; i <= 150; ++i)
      for (std::size_t j = 1; j < i; ++j) {
        if (corners == 3) {
          const double* a = &soup.vertices[3 * soup.elements[3 * i]];
          const double* b = &soup.vertices[3 * soup.elements[3 * j]];
          if (std::fabs((a[2] - 0.3 * a[0] + 0.7 * a[1]) - (b[2] - 0.3 * b[0] + 0.7 * b[1])) > 0.5) continue;
        }
        const double both = common(soup, i, j, corners);
        if (both < 1e-12) continue;
        ++overlaps;
        sum += both;
      }
    CHECK(overlaps > 100);
    CHECK(found.overlaps == overlaps);
    CHECK(found.overlap == doctest::Approx(sum).epsilon(1e-9));
  }
}

}  // namespace powercell
