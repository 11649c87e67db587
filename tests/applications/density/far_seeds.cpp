// Integrals over cells whose seeds are so far from the domain that distances to them lose its digits.
#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <powercell/shapes.hpp>

#include "tests/applications/density/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr double near_distance = 0.25;  // of a seed from the wall

Domain square() {
  const Parts outline{{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {}}};
  return Domain::polygon(outline);
}
Domain cube() {
  const double low[] = {-1, -1, -1}, high[] = {1, 1, 1};
  return Domain::box(low, high);
}

/// Integrals over the cells of two seeds, at -offset and at offset.
DensityIntegrals integrals(const Domain& domain, const Density& density,
                           const std::array<double, 3>& offset) {
  const auto d = static_cast<std::size_t>(domain.dimension());
  SeedArray seeds{domain.dimension(), {}, {0, 0}};
  for (const double side : {-1.0, 1.0})
    for (std::size_t k = 0; k < d; ++k) seeds.positions.push_back(side * offset[k]);
  Diagram diagram = diagram_of({"", domain, seeds});
  return integrate(diagram, density, true);
}

/// Compares the integrals over cells of far seeds with those of near seeds, which have the same cells up to
/// `rounding` of their corners, in units of the domain. The second moments are compared by the parallel axis
/// theorem.
void check_like_near(const Domain& domain, const Density& density, double far, double rounding) {
  INFO("seeds at ", far);
  const auto d = static_cast<std::size_t>(domain.dimension());
  const double tolerance = 1e-12 + 10 * rounding;
  const DensityIntegrals near = integrals(domain, density, {near_distance}),
                         found = integrals(domain, density, {far});
  for (std::size_t i = 0; i < 2; ++i) {
    REQUIRE(near.mass[i] > 0);
    CHECK(std::abs(found.mass[i] - near.mass[i]) <= tolerance * near.mass[i]);
    double central = near.second_moment[i], second = 0;
    for (std::size_t k = 0; k < d; ++k) {
      CHECK(std::abs(found.centroid[i * d + k] - near.centroid[i * d + k]) <= tolerance);
      const double side = k > 0 ? 0 : i == 0 ? -1 : 1, c = near.centroid[i * d + k];
      central -= near.mass[i] * (c - side * near_distance) * (c - side * near_distance);
      second += near.mass[i] * (c - side * far) * (c - side * far);
    }
    CHECK(std::abs(found.second_moment[i] - central - second) <= tolerance * (central + second));
  }
  REQUIRE(near.walls.wall.size() == 2);
  REQUIRE(found.walls.wall.size() == 2);
  CHECK(std::abs(found.walls.wall[0] - near.walls.wall[0]) <= tolerance * near.walls.wall[0]);
}

/// Number of evaluations of a density for these integrals.
std::size_t evaluations(const Domain& domain, double far) {
  std::atomic<std::size_t> count{0};
  const Density density = Density::function(
      [&](const std::array<double, 3>& x) {
        ++count;
        return 3 + x[0] * x[0];
      },
      1e-6);
  const double total = density.total(domain);  // cached from here on
  count = 0;
  const DensityIntegrals found = integrals(domain, density, {far, far, far});
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(found.mass[i] >= 0);
    CHECK(found.mass[i] <= 10 * total);
    CHECK(found.second_moment[i] >= 0);
  }
  return count;
}

}  // namespace

TEST_CASE("far seeds have the integrals of near seeds with the same cells") {
  const std::vector<double> pixels{1, 2, 3, 5, 0, 4};
  ImageView image;
  image.width = 3;
  image.height = 2;
  image.values = pixels;
  image.low = {-1, -1};
  image.high = {1, 1};
  for (const double far : {1e3, 1e6, 1e9}) {
    const double rounding = far * 0x1p-52;
    for (const char* formula : {"2", "3+x+2*y", "1+x*x"}) {
      INFO(formula);
      const Density density = Density::formula(formula);
      check_like_near(square(), density, far, 0);
      check_like_near(cube(), density, far, 0);
      check_like_near(surface_of(icosphere(1)), density, far, rounding);
      check_like_near(volume_of(ball_tetrahedra(1)), density, far, rounding);
    }
    check_like_near(square(), Density::image(image), far, 0);
  }
}

TEST_CASE("cells distorted by rounding take no more evaluations than others") {
  const Domain domains[] = {square(), cube(), surface_of(icosphere(0)), volume_of(ball_tetrahedra(1))};
  for (const Domain& domain : domains) {
    const std::size_t near = evaluations(domain, near_distance);
    CHECK(near > 0);
    for (const double far : {1e15, 3e15, 2.5e29}) {
      INFO("seeds at ", far);
      CHECK(evaluations(domain, far) <= 4 * near);
    }
  }
}
