// Parts of cells apart from their points, on domains whose parts are known.
#include "lib/applications/sampling/apart.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <powercell/diagram.hpp>
#include <powercell/sampling.hpp>
#include <random>

#include "lib/applications/sampling/nearest.hpp"
#include "lib/applications/sampling/solid_cells.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

PartsApart apart_of(const Domain& domain, const std::vector<double>& seeds) {
  Diagram diagram(main_setups().front().device, domain);
  diagram.set_seeds({domain.dimension(), seeds, {}});
  return parts_apart(diagram.cells(), seeds);
}

PolygonPart rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

/// The squares [0, 1]^2 at height 0 and [0, side]^2 at height `gap`.
Domain two_squares(double side, double gap) {
  const std::vector<double> vertices{0, 0, 0,   1,    0, 0,   1,    1,    0,   0, 1,    0,
                                     0, 0, gap, side, 0, gap, side, side, gap, 0, side, gap};
  return Domain::surface(vertices, std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7});
}

/// Boxes as tetrahedra and as the closed surfaces of these.
struct Boxes {
  std::vector<double> vertices;
  std::vector<std::uint32_t> tetrahedra, triangles;

  void add(const std::array<double, 3>& low, const std::array<double, 3>& high) {
    const auto base = static_cast<std::uint32_t>(vertices.size() / 3);
    for (unsigned v = 0; v < 8; ++v)
      for (unsigned c = 0; c < 3; ++c) vertices.push_back(v >> c & 1 ? high[c] : low[c]);
    // Six around the diagonal from corner 0 to corner 7, two triangles of each side.
    constexpr std::array<std::uint32_t, 7> around{1, 3, 2, 6, 4, 5, 1};
    for (std::size_t k = 0; k < 6; ++k) {
      const std::uint32_t a = around[k], b = around[k + 1];
      for (const std::uint32_t v : {0u, a, b, 7u}) tetrahedra.push_back(base + v);
      for (const std::uint32_t v : {0u, b, a, a, b, 7u}) triangles.push_back(base + v);
    }
  }
};

PartsApart apart_in_solid(const Domain& solid, const std::vector<double>& seeds) {
  Diagram diagram(main_setups().front().device, solid);
  diagram.set_seeds({3, seeds, {}});
  return parts_apart(diagram.joined(), seeds);
}

}  // namespace

TEST_CASE("a cell on two squares is apart by the area of the one without the point") {
  INFO(replay_hint());
  const PartsApart below = apart_of(two_squares(0.5, 0.01), {0.25, 0.25, 0});
  CHECK(below.cells == 1);
  CHECK(below.share == doctest::Approx(0.25 / 1.25));
  CHECK(below.distance == doctest::Approx(0.01));
  const PartsApart above = apart_of(two_squares(0.5, 0.01), {0.25, 0.25, 0.01});
  CHECK(above.share == doctest::Approx(1 / 1.25));
  // The centroid of the large square is not below the small one's middle.
  CHECK(above.distance == doctest::Approx(0.01));
  // Each has its own point.
  CHECK(apart_of(two_squares(0.5, 0.01), {0.3, 0.25, 0, 0.3, 0.25, 0.01}).share == 0);
}

TEST_CASE("cells that are connected around an edge are not apart from their points") {
  INFO(replay_hint());
  CHECK(apart_of(surface_of(torus(24, 12)), {1, 0, 0}).share == 0);
  CHECK(apart_of(Domain::polygon(square_with_holes()), {0.1, 0.1}).share == 0);
}

TEST_CASE("parts are found in the plane and in volumes") {
  INFO(replay_hint());
  const Domain plane = Domain::polygon(std::vector{rectangle(0, 0, 1, 1), rectangle(1.5, 0, 2, 1)});
  const PartsApart across = apart_of(plane, {0.4, 0.5});
  CHECK(across.cells == 1);
  CHECK(across.share == doctest::Approx(0.5 / 1.5));
  CHECK(across.distance == doctest::Approx(0.75));  // from (1.75, 0.5) to the edge at x = 1
  std::vector<double> vertices;
  std::vector<std::uint32_t> tetrahedra;
  for (const double x : {0.0, 3.0}) {
    const auto base = static_cast<std::uint32_t>(vertices.size() / 3);
    vertices.insert(vertices.end(), {x, 0, 0, x + 1, 0, 0, x, 1, 0, x, 0, 1});
    tetrahedra.insert(tetrahedra.end(), {base, base + 1, base + 2, base + 3});
  }
  const PartsApart space = apart_of(Domain::volume(vertices, tetrahedra), {0.2, 0.2, 0.2});
  CHECK(space.cells == 1);
  CHECK(space.share == doctest::Approx(0.5));
  // From (3.25, 0.25, 0.25) to the corner (1, 0, 0).
  CHECK(space.distance == doctest::Approx(std::sqrt(2.25 * 2.25 + 2 * 0.25 * 0.25)));
}

TEST_CASE("parts and nearest points in a solid are those of its tetrahedra") {
  INFO(replay_hint());
  Boxes boxes;
  boxes.add({0, 0, 0}, {1, 1, 1});
  boxes.add({1.5, 0, 0}, {2, 1, 1});
  boxes.add({0.2, 0.1, 1.25}, {1.8, 0.9, 1.5});
  const Domain volume = Domain::volume(boxes.vertices, boxes.tetrahedra);
  const Domain solid = Domain::solid(boxes.vertices, boxes.triangles);
  for (const std::size_t n : {1, 2, 5, 40}) {
    std::mt19937_64 random(n);
    std::uniform_real_distribution<double> place(-0.5, 2.5);
    std::vector<double> seeds(3 * n);
    for (double& x : seeds) x = place(random);
    const PartsApart expected = apart_of(volume, seeds), found = apart_in_solid(solid, seeds);
    CHECK(found.cells == expected.cells);
    CHECK((n > 2 || found.cells == n));
    CHECK(found.share == doctest::Approx(expected.share));
    CHECK(found.distance == doctest::Approx(expected.distance));

    Diagram pieces(main_setups().front().device, volume), whole(main_setups().front().device, solid);
    pieces.set_seeds({3, seeds, {}});
    whole.set_seeds({3, seeds, {}});
    for (std::size_t i = 0; i < n; ++i) {
      if (!(pieces.measures().mass[i] > 0)) continue;
      for (int k = 0; k < 20; ++k) {
        const std::array<double, 3> x{place(random), place(random), place(random)};
        const std::array<double, 3> a = nearest_in_cell(pieces.cells(), i, x);
        const std::array<double, 3> b = nearest_in_cell(whole.joined(), i, x);
        for (std::size_t c = 0; c < 3; ++c) CHECK(a[c] == doctest::Approx(b[c]).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("a body in the cavity of another is apart from it by less than the whole cavity") {
  INFO(replay_hint());
  Boxes boxes;
  boxes.add({0, 0, 0}, {4, 4, 4});
  boxes.add({1, 1, 1}, {3, 3, 3});
  boxes.add({1.5, 1.5, 1.5}, {2.5, 2.5, 2.5});
  const Domain solid = Domain::solid(boxes.vertices, boxes.triangles);
  const PartsApart outer = apart_in_solid(solid, {0.5, 2, 2});
  CHECK(outer.cells == 1);
  CHECK(outer.share == doctest::Approx(1.0 / 57));
  CHECK(outer.distance == doctest::Approx(1));  // from the middle to the cavity's wall
  const PartsApart inner = apart_in_solid(solid, {2, 2, 2});
  CHECK(inner.share == doctest::Approx(56.0 / 57));
  CHECK(inner.distance == doctest::Approx(0));
}

TEST_CASE("points in a solid lie in it, also where its cells are not convex") {
  INFO(replay_hint());
  const Domain solid = [] {
    const Mesh mesh = torus(24, 12);
    return Domain::solid(mesh.vertices, mesh.elements);
  }();
  for (const SamplingMode mode : {SamplingMode::blue, SamplingMode::quantise}) {
    SamplingOptions options;
    options.mode = mode;
    const SamplingResult points = sample(main_setups().front().device, solid, 30, options);
    CHECK(points.converged);
    for (const double mass : points.mass) CHECK(mass * 30 == doctest::Approx(solid.measure()).epsilon(1e-5));
    for (std::size_t i = 0; i < 30; ++i) {
      const double* x = &points.positions[3 * i];
      const double ring = std::hypot(x[0], x[1]);
      CHECK(std::hypot(ring - 1, x[2]) < 0.5);
    }
  }
}
