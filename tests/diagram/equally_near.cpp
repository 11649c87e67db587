// Seeds of which most are as far from one point as others, to rounding: on circles, spheres, cylinders and
// cones. There each cell has a vertex that all of them come near. The right neighbours are CGAL's; random
// angles make no exact ties.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <powercell/diagram.hpp>
#include <string>

#include "tests/support/cgal.hpp"
#include "tests/support/generators.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

double angle(Random& random) {
  return random.uniform(0, 2 * std::numbers::pi);
}

/// The point of a circle about (x, 0), in the plane or at height z.
void push_on_circle(SeedArray& seeds, double x, double radius, double at, double z = 0) {
  if (seeds.dimension == 2)
    seeds.push({x + radius * std::cos(at), radius * std::sin(at)}, 0);
  else
    seeds.push({x + radius * std::cos(at), radius * std::sin(at), z}, 0);
}

SeedArray on_circle(std::size_t n, double extent, Random& random) {
  SeedArray seeds{2, {}, {}};
  for (std::size_t k = 0; k < n; ++k) push_on_circle(seeds, 0, 1, random.uniform(0, extent));
  return seeds;
}

SeedArray on_two_circles(double x, double radius, std::size_t n, Random& random) {
  SeedArray seeds{2, {}, {}};
  for (std::size_t k = 0; k < n; ++k)
    push_on_circle(seeds, k % 2 == 0 ? -x : x, k % 2 == 0 ? 1 : radius, angle(random));
  return seeds;
}

SeedArray on_sphere(std::size_t n, Random& random) {
  SeedArray seeds{3, {}, {}};
  for (std::size_t k = 0; k < n; ++k) {
    const double z = random.uniform(-1, 1);
    push_on_circle(seeds, 0, std::sqrt(1 - z * z), angle(random), z);
  }
  return seeds;
}

/// Integer points that tie exactly in the origin, scaled by a power of 2.
SeedArray on_integer_sphere() {
  SeedArray seeds{3, {}, {}};
  for (int x = -31; x <= 31; ++x)
    for (int y = -31; y <= 31; ++y)
      for (int z = -31; z <= 31; ++z)
        if (x * x + y * y + z * z == 1001) seeds.push({x / 32.0, y / 32.0, z / 32.0}, 0);
  return seeds;
}

/// On a few circles about an axis, of radius 1 + slope z.
SeedArray on_rings(std::size_t n, double slope, Random& random) {
  SeedArray seeds{3, {}, {}};
  for (std::size_t k = 0; k < n; ++k) {
    const double z = static_cast<double>(random.index(7)) / 4 - 0.75;
    push_on_circle(seeds, 0, 1 + slope * z, angle(random), z);
  }
  return seeds;
}

SeedArray with_middle(SeedArray seeds) {
  std::vector<double> origin(static_cast<std::size_t>(seeds.dimension), 0.0);
  seeds.positions.insert(seeds.positions.end(), origin.begin(), origin.end());
  seeds.weights.push_back(0);
  return seeds;
}

/// With radii over a tenth, and weights that leave the power distances from the origin as they were.
SeedArray with_weights(SeedArray seeds, Random& random) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const double factor = random.uniform(0.9, 1);
    double square = 0;
    for (std::size_t k = 0; k < d; ++k) {
      seeds.positions[i * d + k] *= factor;
      square += seeds.positions[i * d + k] * seeds.positions[i * d + k];
    }
    seeds.weights[i] = square;
  }
  return seeds;
}

SeedArray shaken(SeedArray seeds, double size, Random& random) {
  for (double& x : seeds.positions) x += size * random.normal();
  return seeds;
}

constexpr double extent = 20;  ///< of the domain on each side of the origin

/// Whether the point with the same power distance from all corners of a simplex is well inside the domain.
bool is_in_domain(const SeedArray& seeds, const std::uint32_t* simplex) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic> rows(d, d);
  Eigen::Matrix<long double, Eigen::Dynamic, 1> offsets(d);
  const auto lifted = [&](std::uint32_t i) {
    long double square = -static_cast<long double>(seeds.weights[i]);
    for (std::size_t k = 0; k < d; ++k) {
      const long double x = seeds.positions[i * d + k];
      square += x * x;
    }
    return square;
  };
  for (std::size_t r = 0; r < d; ++r) {
    for (std::size_t k = 0; k < d; ++k)
      rows(r, k) = 2 * (static_cast<long double>(seeds.positions[simplex[r + 1] * d + k]) -
                        seeds.positions[simplex[0] * d + k]);
    offsets(r) = lifted(simplex[r + 1]) - lifted(simplex[0]);
  }
  return rows.fullPivLu().solve(offsets).template lpNorm<Eigen::Infinity>() < 0.9L * extent;
}

bool are_neighbors(const Adjacency& adjacency, std::uint32_t i, std::uint32_t j) {
  const auto* row = adjacency.neighbor.data();
  return std::find(row + adjacency.offset[i], row + adjacency.offset[i + 1], j) !=
         row + adjacency.offset[i + 1];
}

/// All neighbours are CGAL's, and those that share a vertex of the diagram in the domain are neighbours.
void check_neighbors(const Adjacency& adjacency, const SeedArray& seeds, const RegularTriangulation& right) {
  std::size_t wrong = 0, missing = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (auto k = adjacency.offset[i]; k < adjacency.offset[i + 1]; ++k)
      wrong += !std::binary_search(right.neighbor.begin() + static_cast<std::ptrdiff_t>(right.offset[i]),
                                   right.neighbor.begin() + static_cast<std::ptrdiff_t>(right.offset[i + 1]),
                                   adjacency.neighbor[k]);
  const auto corners = static_cast<std::size_t>(seeds.dimension) + 1;
  std::size_t vertices = 0;
  for (const std::uint32_t* simplex = right.simplices.data();
       simplex < right.simplices.data() + right.simplices.size(); simplex += corners) {
    if (!is_in_domain(seeds, simplex)) continue;
    ++vertices;
    for (std::size_t a = 0; a < corners; ++a)
      for (std::size_t b = 0; b < a; ++b) missing += !are_neighbors(adjacency, simplex[a], simplex[b]);
  }
  CHECK(wrong == 0);
  CHECK(missing == 0);
  CHECK(vertices > seeds.size() / 20);
}

void check(const std::string& name, const SeedArray& seeds) {
  INFO(name << ", " << seeds.size() << " seeds; " << replay_hint());
  const RegularTriangulation right = regular_triangulation(seeds.view());
  const std::vector<double> low(static_cast<std::size_t>(seeds.dimension), -extent), high(low.size(), extent);
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    Diagram diagram(setup.device, Domain::box(low, high), setup.options);
    diagram.set_seeds(seeds.view());
    diagram.compute(true, false);
    for (std::size_t i = 0; i < seeds.size(); ++i)
      if ((diagram.measures().status[i] == SeedStatus::hidden) != (right.hidden[i] != 0))
        FAIL_CHECK("seed " << i << " is hidden, or is not");
    check_neighbors(diagram.adjacency(), seeds, right);
    CHECK(diagram.measures().relative_error() < (diagram.precision() == Precision::float32 ? 1e-5 : 1e-12));
  }
}

}  // namespace

TEST_CASE("cells that many seeds come near have the same bits in any number of threads") {
  Random random(test_seed());
  for (const SeedArray& seeds :
       {on_circle(1000, 2 * std::numbers::pi, random), on_sphere(400, random), on_integer_sphere()}) {
    std::vector<double> mass, wall;
    for (const int threads : {1, 2, 3}) {
      Options options;
      options.threads = threads;
      const std::vector<double> low(static_cast<std::size_t>(seeds.dimension), -2.0), high(low.size(), 2.0);
      Diagram diagram(Device::choose(), Domain::box(low, high), options);
      diagram.set_seeds(seeds.view());
      diagram.compute(true, false);
      CHECK(diagram.timings().on_host > seeds.size() / 2);
      if (threads == 1) {
        mass = diagram.measures().mass;
        wall = diagram.adjacency().wall;
      }
      CHECK(mass == diagram.measures().mass);
      CHECK(wall == diagram.adjacency().wall);
    }
  }
}

TEST_CASE("seeds on circles have the neighbours that CGAL finds") {
  Random random(test_seed());
  const std::size_t n = number_of_inputs(1000u, 6000u);
  const double round = 2 * std::numbers::pi;
  check("circle", on_circle(n, round, random));
  check("arc", on_circle(n, 1, random));
  check("two circles", on_two_circles(1.3, 0.7, n, random));
  check("circles that cross", on_two_circles(0.4, 0.8, n, random));
  check("one circle in another", on_two_circles(0, 0.5, n, random));
  check("circle with a middle", with_middle(on_circle(n, round, random)));
  check("circle with weights", with_weights(on_circle(n, round, random), random));
  for (const double size : {1e-15, 1e-12, 1e-9, 1e-6})
    check("circle, shaken", shaken(on_circle(n, round, random), size, random));
}

TEST_CASE("seeds on spheres, cylinders and cones have the neighbours that CGAL finds") {
  Random random(test_seed());
  const std::size_t n = number_of_inputs(500u, 3000u);
  check("sphere", on_sphere(n, random));
  check("sphere with a middle", with_middle(on_sphere(n, random)));
  check("sphere with weights", with_weights(on_sphere(n, random), random));
  check("cylinder", on_rings(n, 0, random));
  check("cone", on_rings(n, 0.7, random));
  for (const double size : {1e-15, 1e-9}) check("sphere, shaken", shaken(on_sphere(n, random), size, random));
}
