// Spacing and spectra of points with known values, and the distribution of random points.
#include <doctest/doctest.h>

#include <cmath>
#include <powercell/point_sets.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// A hexagonal lattice of spacing 1, periodic in its box.
struct Lattice {
  Domain box;
  std::vector<double> positions;
};
Lattice hexagonal(int columns, int rows) {
  const std::array<double, 2> low{0, 0};
  const std::array<double, 2> high{static_cast<double>(columns), rows * std::sqrt(0.75)};
  Lattice lattice{Domain::box(low, high), {}};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      lattice.positions.push_back(c + (r % 2 ? 0.75 : 0.25));
      lattice.positions.push_back((r + 0.5) * std::sqrt(0.75));
    }
  return lattice;
}

double power_at(const Spectrum& s, int fx, int fy) {
  const int side = 2 * s.highest + 1;
  return s.power[static_cast<std::size_t>((fy + s.highest) * side + fx + s.highest)];
}

}  // namespace

TEST_CASE("the hexagonal lattice has spacing 1 and hexatic order 1") {
  const Lattice lattice = hexagonal(8, 10);
  const Spacing found = spacing(main_setups().front().device, lattice.box, lattice.positions, true);
  CHECK(found.least == doctest::Approx(1));
  CHECK(found.mean == doctest::Approx(1));
  CHECK(found.hexatic == doctest::Approx(1));
}

TEST_CASE("random points have hexatic order 0.37 and the mean distance of a Poisson process") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::size_t n = 4000;
  const SeedArray seeds = scatter(Distribution::white, n, 2, {}, random);
  const Spacing found = spacing(main_setups().front().device, unit_box(2), seeds.positions, true);
  // The mean distance to the nearest is 1 / (2 sqrt n).
  CHECK(found.mean == doctest::Approx(0.5 / std::sqrt(2 / std::sqrt(3.0))).epsilon(0.03));
  CHECK(found.hexatic == doctest::Approx(0.37).epsilon(0.05));
  const SeedArray solid = scatter(Distribution::white, 500, 3, {}, random);
  const Spacing in_space = spacing(main_setups().front().device, unit_box(3), solid.positions);
  CHECK(std::isnan(in_space.hexatic));
  CHECK(in_space.mean > 0.4);
  CHECK(in_space.mean < 0.6);
}

TEST_CASE("a spectrum agrees with the direct sum of waves") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::array<double, 2> low{-1, 2}, high{2, 4};
  const Domain box = Domain::box(low, high);
  const SeedArray seeds = scatter(Distribution::white, 37, 2, {{-1, 2, 0}, {2, 4, 0}}, random);
  const Spectrum found = spectrum(box, seeds.positions, 6, 2);
  REQUIRE(found.power.size() == 169);
  for (int fy = -6; fy <= 6; ++fy)
    for (int fx = -6; fx <= 6; ++fx) {
      double re = 0, im = 0;
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        const double angle = 2 * std::acos(-1.0) *
                             (fx * (seeds.coordinate(i, 0) + 1) / 3 + fy * (seeds.coordinate(i, 1) - 2) / 2);
        re += std::cos(angle);
        im += std::sin(angle);
      }
      CHECK(std::abs(power_at(found, fx, fy) - (re * re + im * im) / 37) < 1e-10);
    }
}

TEST_CASE("a lattice has power in its reciprocal lattice only, random points everywhere") {
  INFO(replay_hint());
  const SeedArray points = grid(8, 2);
  const Spectrum peaks = spectrum(unit_box(2), points.positions, 12);
  for (int fy = -12; fy <= 12; ++fy)
    for (int fx = -12; fx <= 12; ++fx)
      CHECK(std::abs(power_at(peaks, fx, fy) - (fx % 8 == 0 && fy % 8 == 0 ? 64 : 0)) < 1e-9);
  Random random(test_seed());
  std::vector<Spectrum> runs;
  for (int k = 0; k < 8; ++k)
    runs.push_back(spectrum(unit_box(2), scatter(Distribution::white, 256, 2, {}, random).positions));
  const Spectrum average = mean(runs);
  CHECK(average.runs == 8);
  CHECK(average.highest == 32);
  const Spectrum::Radial radial = average.radial();
  REQUIRE(radial.mean.size() == 32);
  double power = 0, anisotropy = 0;
  for (std::size_t k = 8; k < 32; ++k) {
    power += radial.mean[k] / 24;
    anisotropy += radial.anisotropy[k] / 24;
  }
  CHECK(power == doctest::Approx(1).epsilon(0.05));
  CHECK(anisotropy == doctest::Approx(1.0 / 8).epsilon(0.2));
  CHECK(average.low_frequency() == doctest::Approx(1).epsilon(0.25));
}

TEST_CASE("random points follow their density, on every kind of domain") {
  INFO(replay_hint());
  Random shape(7);
  const std::size_t n = 8000;
  for (const Domain& domain : {unit_box(2), unit_box(3), volume_of(cube_tetrahedra(2, 0.1, shape))}) {
    const std::vector<double> points = random_points(domain, Density::formula("3*x^2"), n, test_seed());
    const auto d = static_cast<std::size_t>(domain.dimension());
    REQUIRE(points.size() == n * d);
    double below = 0;  // expected: x^3 at 1/2, an eighth of the points
    for (std::size_t i = 0; i < n; ++i) below += points[i * d] < 0.5 ? 1 : 0;
    CHECK(below / n == doctest::Approx(0.125).epsilon(0.1));
  }
  const std::vector<double> gray{0, 3, 1, 0};  // the upper right pixel has three times the lower left
  const std::vector<double> points = random_points(unit_box(2), Density::image({2, 2, gray}), n, test_seed());
  double right = 0;
  for (std::size_t i = 0; i < n; ++i) {
    CHECK((points[2 * i] > 0.5) == (points[2 * i + 1] > 0.5));
    right += points[2 * i] > 0.5 ? 1 : 0;
  }
  CHECK(right / n == doctest::Approx(0.75).epsilon(0.03));
}

TEST_CASE("points without a neighbour have no spacing") {
  const std::vector<PolygonPart> two{{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}},
                                     {{{5, 0}, {6, 0}, {6, 1}, {5, 1}}, {}}};
  const std::vector<double> apart{0.5, 0.5, 5.5, 0.5};
  const Spacing found = spacing(main_setups().front().device, Domain::polygon(two), apart);
  CHECK(std::isnan(found.least));
  CHECK(std::isnan(found.mean));
  CHECK(std::isnan(found.hexatic));
}

TEST_CASE("invalid input for spacing, spectrum and mean is refused") {
  const Device& device = main_setups().front().device;
  const std::vector<double> one{0.5, 0.5}, twice{0.5, 0.5, 0.5, 0.5}, solid{0.1, 0.2, 0.3};
  CHECK_THROWS_AS(spacing(device, unit_box(2), one), Error);
  CHECK_THROWS_AS(spacing(device, unit_box(2), twice), Error);
  CHECK_THROWS_AS(spectrum(unit_box(3), solid), Error);
  CHECK_THROWS_AS(spectrum(unit_box(2), {}), Error);
  const std::vector<Spectrum> different{spectrum(unit_box(2), one, 3), spectrum(unit_box(2), one, 4)};
  CHECK_THROWS_AS(mean(different), Error);
  CHECK_THROWS_AS(mean({}), Error);
}
