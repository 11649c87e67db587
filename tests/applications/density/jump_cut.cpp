// Densities with jumps: cuts of one simplex against closed forms, then whole diagrams.
#include "lib/applications/density/jump_cut.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "tests/applications/density/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

using Linear = std::array<double, 4>;  // a linear function, by its values at the corners of a simplex

double at(const Linear& f, const Barycentric& point) {
  double value = 0;
  for (std::size_t c = 0; c < point.size(); ++c) value += f[c] * point[c];
  return value;
}

/// The share of a simplex where a linear function is negative, as a sum over the corners where it is.
double share_below(int n, const Linear& f) {
  double share = 0;
  for (int i = 0; i <= n; ++i) {
    if (!(f[i] < 0)) continue;
    double product = 1;
    for (int j = 0; j <= n; ++j)
      if (j != i) product *= f[i] / (f[i] - f[j]);
    share += product;
  }
  return share;
}

Linear random_linear(int n, Random& random) {
  Linear f{};
  for (int c = 0; c <= n; ++c) f[c] = random.uniform(-1, 1);
  return f;
}

template <class Density>
bool cut(int n, const Density& density, double allowed, JumpCut& found, double most = 1e-6) {
  std::vector<double> corner;
  for (int c = 0; c <= n; ++c) {
    Barycentric point{};
    point[c] = 1;
    corner.push_back(density(point));
  }
  const ValuesAt values = [&](std::span<const Barycentric> points, std::span<double> value) {
    std::transform(points.begin(), points.end(), value.begin(), density);
  };
  return cut_at_jump(n, corner, values, allowed, most, found);
}

double mass_of(const JumpCut& found) {
  double mass = 0;
  for (const JumpCut::Term& term : found.terms) mass += term.mass;
  return mass;
}

/// Error estimate: of the position of the jump and of the rules.
double error_of(const JumpCut& found) {
  double lower = 0;
  for (const JumpCut::Term& term : found.terms) lower += term.lower;
  return found.error + std::abs(mass_of(found) - lower);
}

double first_of(const JumpCut& found, std::size_t c) {
  double sum = 0;
  for (const JumpCut::Term& term : found.terms) sum += term.mass * term.point[c];
  return sum;
}

}  // namespace

TEST_CASE("a flat jump through a simplex is integrated exactly, whichever corners it separates") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int n : {1, 2, 3})
    for (int k = 0; k < 200; ++k) {
      const Linear f = random_linear(n, random);
      const double below = share_below(n, f);
      CAPTURE(n);
      CAPTURE(k);
      JumpCut found;
      const bool parted = cut(
          n, [&](const Barycentric& x) { return at(f, x) < 0 ? 5.0 : 2.0; }, 1e-11, found);
      const bool one_side = std::all_of(f.begin(), f.begin() + n + 1, [&](double v) { return v * f[0] > 0; });
      REQUIRE(parted == !one_side);
      if (!parted) continue;
      CHECK(std::abs(mass_of(found) - (2 + 3 * below)) < 1e-10);
      CHECK(std::abs(mass_of(found) - (2 + 3 * below)) <= found.error + 1e-14);
      // First moments in barycentric coordinates sum to the mass.
      double sum = 0;
      for (int c = 0; c <= n; ++c) sum += first_of(found, static_cast<std::size_t>(c));
      CHECK(std::abs(sum - mass_of(found)) < 1e-12);
    }
}

TEST_CASE("the density may vary on both sides of a flat jump") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int n : {1, 2, 3})
    for (int k = 0; k < 50; ++k) {
      const Linear f = random_linear(n, random);
      CAPTURE(n);
      CAPTURE(k);
      // 1 - |f|, and 6 more where f is below 0.
      JumpCut found;
      const bool parted = cut(
          n, [&](const Barycentric& x) { return at(f, x) < 0 ? 7 + at(f, x) : 1 - at(f, x); }, 1e-11, found);
      if (!parted) continue;
      // The mean of |f| is that of f and twice that of max(0, -f), a divided difference again.
      double mean = 0, negative = 0;
      for (int i = 0; i <= n; ++i) {
        mean += f[i] / (n + 1);
        if (!(f[i] < 0)) continue;
        double product = -f[i] / (n + 1);
        for (int j = 0; j <= n; ++j)
          if (j != i) product *= f[i] / (f[i] - f[j]);
        negative += product;
      }
      const double expected = 1 + 6 * share_below(n, f) - (mean + 2 * negative);
      CHECK(std::abs(mass_of(found) - expected) < 1e-9);
    }
}

TEST_CASE("a curved jump is followed between its crossings, and the error estimate covers the rest") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int n : {2, 3}) {
    int parted = 0, honest = 0, good = 0;
    double flat = 0, bent = 0;
    for (int k = 0; k < 100; ++k) {
      // The jump is the graph of a function of the other coordinates; the mass is summed over columns below
      // it.
      const double a = random.uniform(0.1, 0.6), b = random.uniform(-0.5, 0.5), c = random.uniform(-0.5, 0.5);
      const auto border = [&](double bend, double x, double y) {
        return a + b * x + c * y + bend * (x * x + x * y - y * y);
      };
      const double bend = random.uniform(-0.2, 0.2);
      const auto below = [&](const Barycentric& x) {
        return x[static_cast<std::size_t>(n)] < border(bend, x[0], n == 2 ? 0 : x[1]) ? 1.0 : 0.0;
      };
      JumpCut found;
      if (!cut(n, below, 1e-3, found, 1.0)) continue;
      double truth = 0, without_bend = 0;
      const int m = n == 2 ? 100'000 : 400;
      const auto add_column = [&](double x, double y, double share) {
        truth += share * std::clamp(border(bend, x, y), 0.0, 1 - x - y);
        without_bend += share * std::clamp(border(0, x, y), 0.0, 1 - x - y);
      };
      for (int i = 0; i < m; ++i) {
        const double x = (i + 0.5) / m;
        if (n == 2) add_column(x, 0, 2.0 / m);
        for (int j = 0; n == 3 && i + j < m; ++j)
          add_column(i + j + 1 < m ? x : (i + 1.0 / 3) / m, (j + (i + j + 1 < m ? 0.5 : 1.0 / 3)) / m,
                     (i + j + 1 < m ? 6.0 : 3.0) / m / m);
      }
      ++parted;
      const double off = std::abs(mass_of(found) - truth), columns = n == 2 ? 1e-8 : 1e-5;
      honest += off <= error_of(found) + columns ? 1 : 0;
      if (error_of(found) > 1e-2) continue;
      flat += std::abs(without_bend - truth);
      bent += off;
      ++good;
    }
    CAPTURE(n);
    CHECK(parted > 50);
    CHECK(honest >= parted * 9 / 10);
    CHECK(good > parted / 2);
    CHECK(bent < 0.1 * flat);
  }
}

TEST_CASE("kinks, steep slopes, roots, stripes and tiny steps are not taken for jumps") {
  JumpCut found;
  const auto kink = [](const Barycentric& x) { return std::abs(x[0] - 0.4); };
  const auto steep = [](const Barycentric& x) { return std::tanh(1e4 * (x[0] - 0.4)); };
  const auto root = [](const Barycentric& x) { return std::sqrt(x[0]); };
  const auto stripe = [](const Barycentric& x) { return std::abs(x[0] - 0.4) < 0.1 ? 2.0 : 1.0; };
  const auto low = [](const Barycentric& x) { return x[0] < 0.4 ? 1.0 : 1 + 1e-13; };
  for (const int n : {1, 2, 3}) {
    CHECK_FALSE(cut(n, kink, 1e-10, found));
    CHECK_FALSE(cut(n, steep, 1e-10, found));
    CHECK_FALSE(cut(n, root, 1e-10, found));
    CHECK_FALSE(cut(n, stripe, 1e-10, found));  // all corners have the same value
    CHECK_FALSE(cut(n, low, 1e-10, found));
  }
}

TEST_CASE("indicator functions of discs are integrated to 1e-6, mostly to 1e-9") {
  INFO(replay_hint());
  Random random(test_seed());
  const Domain square = unit_box(2);
  Diagram diagram(test_device(), square);
  double worst = 0, worst_total = 0;
  int within = 0;
  constexpr int discs = 20;
  for (int k = 0; k < discs; ++k) {
    const SeedArray seeds = scatter(Distribution::white, 30, 2, {}, random);
    diagram.set_seeds(seeds.view());
    const double radius = random.uniform(0.1, 0.4);
    const double x = random.uniform(radius, 1 - radius), y = random.uniform(radius, 1 - radius);
    const Density disc = Density::function(
        [=](const std::array<double, 3>& p) { return std::hypot(p[0] - x, p[1] - y) < radius ? 4.0 : 1.0; });
    const double expected = 1 + 3 * std::acos(-1.0) * radius * radius;
    const DensityIntegrals found = integrate(diagram, disc, true);
    const double off = std::abs(found.total() - expected);
    worst = std::max(worst, off);
    within += off < 1e-9 ? 1 : 0;
    worst_total = std::max(worst_total, std::abs(disc.total(square) - expected));
    CHECK(found.quadrature_error < 1e-8);
  }
  CHECK(worst < 1e-6);  // a disc may cut a simplex between all points
  CHECK(worst_total < 1e-6);
  CHECK(within >= discs * 3 / 4);
}

TEST_CASE("a jump with corners, and a sphere in space") {
  INFO(replay_hint());
  Random random(test_seed());
  {
    const DensityCase one{"square", unit_box(2), {2, {}, {}}};
    Diagram diagram(test_device(), one.domain);
    diagram.set_seeds(scatter(Distribution::white, 300, 2, {}, random).view());
    const Density box = Density::formula("abs(x-0.5) < 0.3 && abs(y-0.4) < 0.2 ? 3 : 1");
    const DensityIntegrals found = integrate(diagram, box, true);
    CHECK(std::abs(found.total() / 1.48 - 1) < 1e-6);
    CHECK(std::abs(box.total(one.domain) / 1.48 - 1) < 1e-6);
    CHECK(found.quadrature_error < 1e-9);
  }
  {
    const Domain cube = unit_box(3);
    Diagram diagram(test_device(), cube);
    diagram.set_seeds(scatter(Distribution::white, 100, 3, {}, random).view());
    const Density ball = Density::formula("(x-0.5)^2 + (y-0.5)^2 + (z-0.5)^2 < 0.16 ? 3 : 1", 1e-5);
    const double expected = 1 + 2 * 4 * std::acos(-1.0) / 3 * std::pow(0.4, 3);
    const DensityIntegrals found = integrate(diagram, ball, false);
    CHECK(std::abs(found.total() / expected - 1) < 1e-4);
    CHECK(std::abs(ball.total(cube) / expected - 1) < 1e-5);
    CHECK(found.quadrature_error < 1e-4);
  }
}
