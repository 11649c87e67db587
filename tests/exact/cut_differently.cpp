// A square or cube cut into regions has the same diagram: cells, hidden seeds and walls. Bisectors run along
// the cuts, through their corners and along the boundary.
#include <doctest/doctest.h>

#include "tests/exact/tied_seeds.hpp"
#include "tests/support/domains.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Seeds off the plane of a sheet with the same diagram on it as `flat`: the square of the distance from the
/// plane is added to the weight.
/// \param axis  normal of the plane
SeedArray lifted_off(const SeedArray& flat, std::size_t axis, Random& random) {
  SeedArray seeds{3, {}, {}};
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const double z = (static_cast<double>(random.index(9)) - 4) / 8;
    std::array<double, 3> p{};
    p[axis] = z;
    p[(axis + 1) % 3] = flat.positions[2 * i];
    p[(axis + 2) % 3] = flat.positions[2 * i + 1];
    seeds.positions.insert(seeds.positions.end(), p.begin(), p.end());
    seeds.weights.push_back(flat.weights[i] + z * z);
  }
  return seeds;
}

/// The unit square normal to `axis`, in squares cut along one diagonal or the other.
Domain sheet(std::size_t per_side, std::size_t axis, Random& random) {
  std::vector<double> vertices;
  for (std::size_t j = 0; j <= per_side; ++j)
    for (std::size_t i = 0; i <= per_side; ++i) {
      std::array<double, 3> x{};
      x[(axis + 1) % 3] = static_cast<double>(i) / static_cast<double>(per_side);
      x[(axis + 2) % 3] = static_cast<double>(j) / static_cast<double>(per_side);
      vertices.insert(vertices.end(), x.begin(), x.end());
    }
  std::vector<std::uint32_t> triangles;
  for (std::size_t j = 0; j < per_side; ++j)
    for (std::size_t i = 0; i < per_side; ++i) {
      const auto a = static_cast<std::uint32_t>(j * (per_side + 1) + i), b = a + 1;
      const auto c = static_cast<std::uint32_t>(a + per_side + 1), d = c + 1;
      if (random.index(2) == 0) {
        triangles.insert(triangles.end(), {a, b, d, a, d, c});
      } else {
        triangles.insert(triangles.end(), {a, b, c, b, d, c});
      }
    }
  return Domain::surface(vertices, triangles);
}

Domain block(int per_side, Random& random) {
  return volume_of(cube_tetrahedra(per_side, 0, random));
}

/// A square in parts that meet along edges; some corners lie within edges of other parts.
Domain square_in_parts() {
  const auto rectangle = [](double x0, double y0, double x1, double y1) {
    return PolygonPart{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
  };
  const std::vector<PolygonPart> parts{rectangle(0, 0, 0.5, 0.25), rectangle(0.5, 0, 1, 0.5),
                                       rectangle(0, 0.25, 0.5, 1), rectangle(0.5, 0.5, 1, 1)};
  return Domain::polygon(parts);
}

Domain scaled_box(double scale) {
  return Domain::box(std::vector<double>(3, 0.0), std::vector<double>(3, scale));
}

SeedArray scaled(SeedArray seeds, double scale) {
  for (double& x : seeds.positions) x *= scale;
  for (double& w : seeds.weights) w *= scale * scale;
  return seeds;
}

}  // namespace

TEST_CASE("a cube in tetrahedra has the diagram of the cube") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Setup& setup : all_setups())
    for (int trial = 0; trial < 30; ++trial) {
      INFO(setup.name << ", trial " << trial);
      const SeedArray seeds = tied_seeds(2 + random.index(20), 0.5, 3, trial % 2 == 1, random);
      const Outcome whole = outcome_of(setup, unit_box(3), seeds.view());
      const Outcome pieces = outcome_of(setup, block(1 + trial % 4, random), seeds.view());
      expect_same(whole, pieces, 1e3 * unit_roundoff(setup.options.precision));
      CHECK(whole.simplices == pieces.simplices);
      const Outcome small = outcome_of(setup, scaled_box(0x1p-40), scaled(seeds, 0x1p-40).view());
      CHECK(whole.measures.status == small.measures.status);
      CHECK(whole.simplices == small.simplices);
    }
}

TEST_CASE("a square in triangles in space has the diagram of the square") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Setup& setup : all_setups())
    for (int trial = 0; trial < 30; ++trial) {
      INFO(setup.name << ", trial " << trial);
      const SeedArray seeds = tied_seeds(2 + random.index(20), 0.5, 2, false, random);
      const std::size_t axis = random.index(3);
      const Domain square = sheet(1 + random.index(4), axis, random);
      expect_same(outcome_of(setup, unit_box(2), seeds.view()),
                  outcome_of(setup, square, lifted_off(seeds, axis, random).view()),
                  1e3 * unit_roundoff(setup.options.precision));
    }
}

TEST_CASE("a square in parts has the diagram of the square") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Setup& setup : all_setups())
    for (int trial = 0; trial < 30; ++trial) {
      INFO(setup.name << ", trial " << trial);
      const SeedArray seeds = tied_seeds(2 + random.index(20), 0.5, 2, trial % 2 == 1, random);
      const double tolerance = 1e3 * unit_roundoff(setup.options.precision);
      const Outcome whole = outcome_of(setup, unit_box(2), seeds.view());
      const Outcome parts = outcome_of(setup, square_in_parts(), seeds.view());
      expect_same(whole, parts, tolerance);
      CHECK(whole.simplices == parts.simplices);
    }
}
