#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/base/random.hpp"
#include "tests/domain/check_mesh.hpp"

namespace powercell {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return low + (high - low) * powercell::uniform(random);
}

long double shoelace(const Ring& ring) {
  long double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const auto &o = ring[0], &a = ring[k], &b = ring[(k + 1) % ring.size()];
    sum += (static_cast<long double>(a[0]) - o[0]) * (static_cast<long double>(b[1]) - o[1]) -
           (static_cast<long double>(a[1]) - o[1]) * (static_cast<long double>(b[0]) - o[0]);
  }
  return std::fabs(sum / 2);
}

/// A ring around a centre with radii between `inner` and `outer`, in a random orientation.
Ring star(Random& random, double x, double y, double inner, double outer, int corners) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners, radius = uniform(random, inner, outer);
    ring.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
  }
  if (random() % 2) std::ranges::reverse(ring);
  return ring;
}

TEST_CASE("the pieces of random stars with star-shaped holes and islands tile them") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const double offset = seed % 3 == 0 ? 1e6 : 0, scale = seed % 5 == 0 ? 1e-6 : 1;
    auto any_star = [&](double x, double y, double inner, double outer) {
      const int corners = 3 + static_cast<int>(random() % 60);
      // With few corners the edges of a star pass close to its centre.
      const double least = inner * (corners < 8 ? 1 : 0.5);
      return star(random, offset + scale * x, offset + scale * y, scale * least, scale * outer, corners);
    };
    // Holes lie inside the circle of radius 10, which the edges of the outer ring do not enter.
    std::vector<PolygonPart> parts(1);
    parts[0].outer =
        star(random, offset, offset, scale * 12, scale * 20, 64 + static_cast<int>(random() % 900));
    long double area = shoelace(parts[0].outer);
    std::size_t edges = parts[0].outer.size();
    for (int i = -3; i <= 2; ++i) {
      for (int j = -3; j <= 2; ++j) {
        const double x = 2 * i + 1, y = 2 * j + 1;
        if (random() % 3 == 0) continue;
        parts[0].holes.push_back(any_star(x, y, 0.8, 0.95));
        area -= shoelace(parts[0].holes.back());
        edges += parts[0].holes.back().size();
        // An island within the circle that the edges of the hole do not enter (for a triangle, half its
        // radius).
        if (random() % 2) continue;
        parts.push_back({any_star(x, y, 0.1, 0.19), {}});
        area += shoelace(parts.back().outer);
        edges += parts.back().outer.size();
      }
    }
    const Domain domain = Domain::polygon(parts);
    test::check_mesh(domain);
    CHECK(std::fabs(static_cast<double>(domain.measure() / area - 1)) < 1e-14);
    CHECK(domain.mesh().boundary_count == edges);
    // Pieces are merged: there would be more than one triangle for each edge.
    CHECK(domain.region_count() < 0.75 * edges);
  }
}

TEST_CASE("random rings on a small lattice are tiled if valid, and refused otherwise") {
  int accepted = 0, with_holes = 0;
  Random random(7);
  for (int trial = 0; trial < 6000; ++trial) {
    CAPTURE(trial);
    const int side = 3 + trial % 6;
    auto ring = [&](int corners) {
      Ring points;
      while (static_cast<int>(points.size()) < corners) {
        points.push_back({double(random() % side) / 3, double(random() % side) / 3});
      }
      return points;
    };
    std::vector<PolygonPart> parts{{ring(3 + trial % 7), {}}};
    if (trial % 2) {  // a large square, so that random holes are often valid and touch
      const double s = side / 3.0;
      parts[0].outer = {{0, 0}, {s, 0}, {s, s}, {0, s}};
      for (int h = 0; h <= trial % 3; ++h) parts[0].holes.push_back(ring(3));
    } else if (trial % 3 == 0) {
      parts.push_back({ring(3), {}});
    }
    long double area = 0;
    for (const PolygonPart& part : parts) {
      area += shoelace(part.outer);
      for (const Ring& hole : part.holes) area -= shoelace(hole);
    }
    try {
      const Domain domain = Domain::polygon(parts);
      ++accepted;
      with_holes += !parts[0].holes.empty();
      test::check_mesh(domain);
      CHECK(std::fabs(static_cast<double>(domain.measure() / area - 1)) < 1e-13);
    } catch (const Error& error) {
      CHECK_MESSAGE(error.code() == ErrorCode::invalid_domain, error.what());
      // The triangulation succeeds whenever the checks pass.
      CHECK_MESSAGE(std::string(error.what()).find("less than rounding") == std::string::npos, error.what());
    }
  }
  CHECK(accepted > 1000);
  CHECK(with_holes > 500);
}

TEST_CASE("squares of a grid, one part each, become one domain") {
  Random random(11);
  const int side = 12;
  std::vector<PolygonPart> parts;
  bool taken[side + 2][side + 2]{};
  for (int i = 1; i <= side; ++i) {
    for (int j = 1; j <= side; ++j) {
      if (random() % 4 == 0) continue;
      taken[i][j] = true;
      const double x = i * 0.1, y = j * 0.1, x1 = (i + 1) * 0.1, y1 = (j + 1) * 0.1;
      parts.push_back({{{x, y}, {x1, y}, {x1, y1}, {x, y1}}, {}});
    }
  }
  std::size_t outer_edges = 0;
  for (int i = 1; i <= side; ++i) {
    for (int j = 1; j <= side; ++j) {
      if (taken[i][j])
        outer_edges += !taken[i - 1][j] + !taken[i + 1][j] + !taken[i][j - 1] + !taken[i][j + 1];
    }
  }
  const Domain domain = Domain::polygon(parts);
  test::check_mesh(domain);
  CHECK(domain.region_count() == parts.size());
  CHECK(domain.mesh().boundary_count == outer_edges);
}

TEST_CASE("a comb of many teeth and a spiral") {
  Ring comb{{-1, -1}, {20001, -1}};
  for (int k = 10000; k >= 0; --k) {
    comb.push_back({2.0 * k, 10});
    if (k > 0) comb.push_back({2.0 * k - 1, 0});
  }
  const Domain teeth = Domain::polygon(std::vector<PolygonPart>{{comb, {}}});
  test::check_mesh(teeth);
  CHECK(teeth.measure() == doctest::Approx(static_cast<double>(shoelace(comb))).epsilon(1e-14));

  Ring spiral;
  const int steps = 2000;
  for (int k = 0; k <= steps; ++k) {
    const double t = 20.0 * k / steps + 1;
    spiral.push_back({t * std::cos(3 * t), t * std::sin(3 * t)});
  }
  for (int k = steps; k >= 0; --k) {
    const double t = 20.0 * k / steps + 1;
    spiral.push_back({(t + 0.3) * std::cos(3 * t), (t + 0.3) * std::sin(3 * t)});
  }
  const Domain wound = Domain::polygon(std::vector<PolygonPart>{{spiral, {}}});
  test::check_mesh(wound);
  CHECK(wound.measure() == doctest::Approx(static_cast<double>(shoelace(spiral))).epsilon(1e-14));
}

}  // namespace
}  // namespace powercell
