// Parts of cells apart from their points, on domains whose parts are known.
#include "lib/applications/sampling/apart.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <powercell/diagram.hpp>

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
