// Random points of densities that are nearly 0 almost everywhere: narrow peaks, tiny spots.
#include <doctest/doctest.h>

#include <cmath>
#include <numeric>
#include <powercell/point_sets.hpp>
#include <powercell/shapes.hpp>

#include "tests/support/domains.hpp"
#include "tests/support/meshes.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Place = std::array<double, 3>;

double squared_distance(const Place& a, const Place& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

std::vector<Place> places(const Domain& domain, const Density& density, std::size_t n, std::uint64_t seed) {
  const std::vector<double> found = random_points(domain, density, n, seed);
  const auto d = static_cast<std::size_t>(domain.dimension());
  REQUIRE(found.size() == n * d);
  std::vector<Place> result(n, Place{});
  for (std::size_t i = 0; i < n; ++i) std::copy_n(&found[i * d], d, result[i].begin());
  return result;
}

/// Pearson's statistic of counts with equal expectations: about the number of bins.
double chi_square(const std::vector<std::size_t>& bins) {
  const double expected = static_cast<double>(std::accumulate(bins.begin(), bins.end(), std::size_t{0})) /
                          static_cast<double>(bins.size());
  double sum = 0;
  for (const std::size_t count : bins) sum += std::pow(static_cast<double>(count) - expected, 2) / expected;
  return sum;
}

/// A peak about `centre` with the density (1 + r²/s²)^-2 in the plane, ^-5/2 in space. within() is the share
/// of its mass that is nearer to the centre than x.
struct Peak {
  Place centre;
  double width;
  bool solid;

  Density density() const {
    return Density::function([peak = *this](const Place& x) {
      const double u = squared_distance(x, peak.centre) / (peak.width * peak.width);
      return std::pow(1 + u, peak.solid ? -2.5 : -2.0);
    });
  }
  double within(const Place& x) const {
    const double r2 = squared_distance(x, centre), share = r2 / (r2 + width * width);
    return solid ? std::pow(share, 1.5) : share;
  }
};

/// Compares the counts in 10 shells of equal mass, each divided into the quadrants or octants about the
/// centre.
void check_peak(const Domain& domain, const Peak& peak, std::uint64_t seed) {
  const std::size_t n = 20000, directions = peak.solid ? 8 : 4;
  std::vector<std::size_t> bins(10 * directions);
  for (const Place& x : places(domain, peak.density(), n, seed)) {
    const auto shell = std::min<std::size_t>(9, static_cast<std::size_t>(10 * peak.within(x)));
    std::size_t direction = 0;
    for (std::size_t k = 0; (std::size_t{1} << k) < directions; ++k)
      direction += (x[k] > peak.centre[k] ? 1u : 0u) << k;
    ++bins[shell * directions + direction];
  }
  // Five standard deviations of the statistic.
  const auto freedom = static_cast<double>(bins.size() - 1);
  CHECK(chi_square(bins) < freedom + 5 * std::sqrt(2 * freedom));
}

}  // namespace

TEST_CASE("points follow narrow peaks, in the plane, in space, and in meshes") {
  Random shape(7), random(11);
  const Domain meshed = volume_of(cube_tetrahedra(3, 0.1, shape));
  const Domain holes = Domain::polygon(std::vector<PolygonPart>{
      {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{{0.7, 0.7}, {0.8, 0.7}, {0.8, 0.8}, {0.7, 0.8}}}}});
  for (const double width : {1e-4, 1e-3}) {  // the boundary would cut off too much of wider ones
    if (width > 1e-4 && !all_inputs()) continue;
    CAPTURE(width);
    const Place flat{random.uniform(0.3, 0.6), random.uniform(0.3, 0.6), 0};
    const Place centre{flat[0], flat[1], random.uniform(0.3, 0.6)};
    check_peak(unit_box(2), {flat, width, false}, 1);
    check_peak(holes, {flat, width, false}, 2);
    check_peak(unit_box(3), {centre, width, true}, 3);
    check_peak(meshed, {centre, width, true}, 4);
  }
}

TEST_CASE("points follow a narrow peak on a surface") {
  const TriangleMesh skin = sphere(6);
  const Domain domain = Domain::surface(skin.vertices, skin.triangles);
  Place centre{};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t k = 0; k < 3; ++k) centre[k] += skin.vertices[3 * skin.triangles[c] + k] / 3;
  const Peak peak{centre, 1e-4, false};
  std::vector<std::size_t> bins(20);
  for (const Place& x : places(domain, peak.density(), 20000, 5))
    ++bins[std::min<std::size_t>(19, static_cast<std::size_t>(20 * peak.within(x)))];
  CHECK(chi_square(bins) < 19 + 5 * std::sqrt(38.0));
}

TEST_CASE("a Gaussian that underflows to 0 almost everywhere is found by its flank") {
  Random random(3);
  for (const int d : {2, 3})
    for (int trial = 0; trial < number_of_inputs(2, 4); ++trial) {
      const double width = d == 2 ? 1e-4 : 1e-3;
      Place centre{};
      for (int k = 0; k < d; ++k) centre[static_cast<std::size_t>(k)] = random.uniform(0.2, 0.8);
      CAPTURE(d);
      CAPTURE(trial);
      const Density gauss = Density::function(
          [=](const Place& x) { return std::exp(-squared_distance(x, centre) / (2 * width * width)); });
      const std::size_t n = 20000;
      double second = 0;
      Place mean{};
      for (const Place& x : places(unit_box(d), gauss, n, 1)) {
        second += squared_distance(x, centre) / (n * width * width * d);
        for (std::size_t k = 0; k < 3; ++k) mean[k] += (x[k] - centre[k]) / (n * width);
      }
      const double deviation = std::sqrt(2.0 / (n * static_cast<double>(d)));  // of the mean of squares
      CHECK(std::abs(second - 1) < 5 * deviation);
      for (int k = 0; k < d; ++k)
        CHECK(std::abs(mean[static_cast<std::size_t>(k)]) < 5 / std::sqrt(static_cast<double>(n)));
    }
}

TEST_CASE("two peaks get points in proportion to their masses; the same random seed gives the same points") {
  const Place one{0.21, 0.33, 0}, two{0.68, 0.75, 0};
  const Density both = Density::function([=](const Place& x) {
    const auto peak = [&](const Place& c, double s) {
      return std::pow(1 + squared_distance(x, c) / (s * s), -2.0);
    };
    return peak(one, 1e-4) + 3.0 / 4 * peak(two, 2e-4);  // four times the area
  });
  const std::size_t n = 20000;
  double first = 0;
  for (const Place& x : places(unit_box(2), both, n, 1)) first += squared_distance(x, one) < 0.01 ? 1 : 0;
  CHECK(std::abs(first / n - 0.25) < 5 * std::sqrt(0.25 * 0.75 / n));
  const std::vector<double> points = random_points(unit_box(2), both, 100, 9);
  CHECK(points == random_points(unit_box(2), both, 100, 9));
  CHECK(points != random_points(unit_box(2), both, 100, 10));
}

TEST_CASE("one positive pixel in a million") {
  std::vector<double> gray(1000 * 1000, 0.0);
  gray[1000 * 411 + 322] = 1;  // from the top
  std::vector<std::size_t> bins(16);
  for (const Place& x : places(unit_box(2), Density::image({1000, 1000, gray}), 4000, 1)) {
    const double u = 1000 * x[0] - 322, v = 1000 * (1 - x[1]) - 411;
    REQUIRE((u >= 0 && u <= 1 && v >= 0 && v <= 1));
    ++bins[std::min<std::size_t>(3, static_cast<std::size_t>(4 * u)) +
           4 * std::min<std::size_t>(3, static_cast<std::size_t>(4 * v))];
  }
  CHECK(chi_square(bins) < 15 + 5 * std::sqrt(30.0));
}

TEST_CASE("small spots without flanks are refused, with advice") {
  for (const double radius : {1e-6, 5e-3}) {
    CAPTURE(radius);
    const Density ball = Density::function([radius](const Place& x) {
      return squared_distance(x, {0.31, 0.42, 0.53}) < radius * radius ? 1.0 : 0.0;
    });
    std::string message;
    try {
      random_points(unit_box(3), ball, 10, 1);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      message = error.what();
    }
    CHECK(message.find("choose a smaller domain") != std::string::npos);
  }
}
