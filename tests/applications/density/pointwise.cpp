// Formulas, functions and values at vertices: integrals against measures of the cells and closed forms;
// accuracy at peaks, kinks and jumps; determinism.
#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "lib/applications/density/simplex_rule.hpp"
#include "tests/applications/density/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

double centroid(const std::vector<double>& centroids, int d, std::size_t i, int k) {
  return k < d ? centroids[i * static_cast<std::size_t>(d) + static_cast<std::size_t>(k)] : 0.0;
}

/// Checks that the masses sum to the total and that statuses and NaN centroids are consistent with them.
void check_sums(const DensityIntegrals& found, double tolerance) {
  CHECK(found.relative_error() < tolerance);
  CHECK(found.quadrature_error == 0);
  for (std::size_t i = 0; i < found.mass.size(); ++i) {
    CHECK((found.mass[i] > 0) == (found.status[i] == SeedStatus::ok));
    CHECK(std::isnan(found.centroid[i * static_cast<std::size_t>(found.dimension)]) == (found.mass[i] == 0));
  }
}

/// Checks the masses of rho = 1 + 0.3 x + 0.2 y + 0.4 z: the measure of a cell times rho at its centroid.
void check_affine(const DensityCase& one, const Density& density) {
  Diagram diagram = diagram_of(one);
  const DensityIntegrals found = integrate(diagram, density, false);
  const Measures& plain = diagram.measures();
  const int d = plain.dimension;
  for (std::size_t i = 0; i < plain.mass.size(); ++i) {
    if (plain.status[i] != SeedStatus::ok) continue;
    double at_centroid = 1;
    const double slope[3] = {0.3, 0.2, 0.4};
    for (int k = 0; k < d; ++k) at_centroid += slope[k] * centroid(plain.centroid, d, i, k);
    CHECK(found.mass[i] == doctest::Approx(plain.mass[i] * at_centroid).epsilon(1e-10));
  }
  check_sums(found, 1e-10);
}

}  // namespace

TEST_CASE("an affine density: the mass is the measure times the value at the centroid") {
  INFO(replay_hint());
  for (const DensityCase& one : flat_cases(60)) {
    INFO(one.name);
    const bool planar = one.domain.dimension() == 2;
    check_affine(one, Density::formula(planar ? "1 + 0.3*x + 0.2*y" : "1 + 0.3*x + 0.2*y + 0.4*z"));
    check_affine(one, Density::function([](const std::array<double, 3>& x) {
                   return 1 + 0.3 * x[0] + 0.2 * x[1] + 0.4 * x[2];
                 }));
  }
}

TEST_CASE("a quadratic density: the mass is a second moment, and the walls are derivatives") {
  INFO(replay_hint());
  for (const DensityCase& one : flat_cases(60)) {
    INFO(one.name);
    const bool planar = one.domain.dimension() == 2;
    const Density density =
        Density::formula(planar ? "(x-0.2)^2 + (y-0.3)^2 + 0.01" : "(x-0.2)^2 + (y-0.3)^2 + (z-0.1)^2");
    Diagram diagram = diagram_of(one);
    const DensityIntegrals found = integrate(diagram, density, false);
    const Measures& plain = diagram.measures();
    const int d = plain.dimension;
    for (std::size_t i = 0; i < plain.mass.size(); ++i) {
      if (plain.status[i] != SeedStatus::ok) continue;
      // |x - q|^2 = |x - p|^2 + 2 (x - p).(p - q) + |p - q|^2, and z = 0 in the plane.
      double expected = plain.second_moment[i];
      const double q[3] = {0.2, 0.3, 0.1};
      for (int k = 0; k < 3; ++k) {
        const double p = k < d ? one.seeds.coordinate(i, k) : 0.0;
        const double c = centroid(plain.centroid, d, i, k);
        expected += plain.mass[i] * (p - q[k]) * (2 * (c - p) + p - q[k]);
      }
      CHECK(std::abs(found.mass[i] - expected) < 1e-11 + 1e-9 * expected);
    }
    check_sums(found, 1e-9);
    check_walls_are_derivatives(one, density, 0.5);
  }
}

TEST_CASE("adaptive quadrature reaches its tolerance at a peak") {
  DensityCase one{"square", unit_box(2), {2, {}, {}}};
  Random random(test_seed());
  one.seeds = scatter(Distribution::white, 30, 2, {}, random);
  // The integral of exp(-a |x - c|^2) over the square, by error functions.
  const double a = 200, c[2] = {0.37, 0.61};
  double expected = 1;
  for (const double m : c)
    expected *=
        std::sqrt(std::acos(-1.0) / a) / 2 * (std::erf(std::sqrt(a) * (1 - m)) + std::erf(std::sqrt(a) * m));
  for (const double tolerance : {1e-6, 1e-9}) {
    const Density peak = Density::formula("exp(-200*((x-0.37)^2 + (y-0.61)^2))", tolerance);
    CHECK(std::abs(peak.total(one.domain) / expected - 1) < tolerance);
    Diagram diagram = diagram_of(one);
    const DensityIntegrals found = integrate(diagram, peak, false);
    CHECK(std::abs(found.total() / expected - 1) < tolerance);
    double moment = 0;
    for (std::size_t i = 0; i < found.mass.size(); ++i)
      if (found.mass[i] > 0) moment += found.mass[i] * found.centroid[2 * i];
    CHECK(std::abs(moment / expected - c[0]) < 10 * tolerance);  // the boundary cuts off less than 1e-11
  }
}

TEST_CASE("a peak is found in cells much larger than it, and in columns much longer") {
  const double pi = std::acos(-1.0);
  std::vector<double> columns;
  for (int k = 0; k < 60; ++k) columns.insert(columns.end(), {(k + 0.5) / 60, 0.5});
  for (const double width : {0.03, 0.01, 0.005, 0.002})
    for (const std::vector<double>& positions :
         {std::vector<double>{0.9, 0.2}, {0.1, 0.1, 0.8, 0.3}, columns}) {
      const DensityCase one{"square", unit_box(2), {2, positions, std::vector<double>(positions.size() / 2)}};
      CAPTURE(width);
      CAPTURE(positions.size() / 2);
      const Density peak = Density::function([width](const std::array<double, 3>& x) {
        const double u = (x[0] - 0.413) / width, v = (x[1] - 0.631) / width;
        return std::exp(-(u * u + v * v) / 2);
      });
      Diagram diagram = diagram_of(one);
      const DensityIntegrals found = integrate(diagram, peak, false);
      CHECK(std::abs(found.total() / (2 * pi * width * width) - 1) < 1e-6);
      CHECK(found.relative_error() < 1e-6);
    }
  for (const double width : {0.04, 0.005}) {
    CAPTURE(width);
    const DensityCase one{"cube", unit_box(3), {3, {0.2, 0.3, 0.4, 0.9, 0.1, 0.5}, {0, 0}}};
    const Density peak = Density::function(
        [width](const std::array<double, 3>& x) {
          const double u = (x[0] - 0.413) / width, v = (x[1] - 0.631) / width, w = (x[2] - 0.52) / width;
          return std::exp(-(u * u + v * v + w * w) / 2);
        },
        1e-5);
    Diagram diagram = diagram_of(one);
    const double expected = std::pow(2 * pi * width * width, 1.5);
    CHECK(std::abs(integrate(diagram, peak, false).total() / expected - 1) < 1e-4);
  }
}

TEST_CASE("a density on a small disc is integrated in cells that extend far beyond it") {
  // A paraboloid on a disc, with seeds about its middle: their cells extend to the sides of the square.
  const double radius = 0.1;
  std::vector<double> positions;
  Random random(test_seed());
  for (int k = 0; k < 60; ++k) positions.push_back(0.5 + 0.14 * (random.uniform() - 0.5));
  const DensityCase one{"square", unit_box(2), {2, positions, std::vector<double>(30)}};
  const Density density = Density::function(
      [radius](const std::array<double, 3>& x) {
        return std::max(0.0, radius * radius - (x[0] - 0.5) * (x[0] - 0.5) - (x[1] - 0.5) * (x[1] - 0.5));
      },
      1e-6);
  Diagram diagram = diagram_of(one);
  const DensityIntegrals found = integrate(diagram, density, false);
  CHECK(std::abs(found.total() / (std::acos(-1.0) * std::pow(radius, 4) / 2) - 1) < 1e-6);
}

TEST_CASE("the error estimate covers a jump nearer to a wall than all points of the rules") {
  for (const double strip : {1e-3, 1e-5, 1e-7}) {
    CAPTURE(strip);
    const DensityCase one{"square", unit_box(2), {2, {0, 0.5, 0.5, 0.5}, {0, 0}}};  // a wall at x = 0.25
    Diagram diagram = diagram_of(one);
    const Density jump = Density::function(
        [strip](const std::array<double, 3>& x) { return x[0] < 0.25 - strip ? 1.0 : 5.0; });
    const DensityIntegrals found = integrate(diagram, jump, false);
    REQUIRE(found.mass_error.size() == 2);
    CHECK(std::abs(found.mass[0] - (0.25 + 4 * strip)) < found.mass_error[0]);
    CHECK(found.mass_error[0] < 1e-2);
    CHECK(found.mass_error[1] == 0);
    CHECK(found.quadrature_error == found.mass_error[0]);
  }
}

TEST_CASE("SimplexRules::most_points is the number of points of the largest rule") {
  for (const int n : {1, 2, 3}) CHECK(simplex_rules(n).size.back() <= SimplexRules::most_points);
  CHECK(simplex_rules(3).size.back() == SimplexRules::most_points);
}

TEST_CASE("a kink between the points of rules is found") {
  INFO(replay_hint());
  struct Kinked {
    DensityCase one;
    double tolerance;
  };
  for (Kinked kinked :
       {Kinked{{"square", unit_box(2), {2, {}, {}}}, 1e-9}, {{"cube", unit_box(3), {3, {}, {}}}, 1e-6}}) {
    CAPTURE(kinked.one.name);
    Random random(test_seed());
    kinked.one.seeds = scatter(Distribution::white, 100, kinked.one.seeds.dimension, {}, random);
    const Density kink =
        Density::function([](const std::array<double, 3>& x) { return 0.1 + std::abs(x[0] - 0.3); });
    Diagram diagram = diagram_of(kinked.one);
    const DensityIntegrals found = integrate(diagram, kink, false);
    const double expected = 0.1 + (0.3 * 0.3 + 0.7 * 0.7) / 2;
    CHECK(std::abs(found.total() / expected - 1) < kinked.tolerance);
    CHECK(std::abs(kink.total(kinked.one.domain) / expected - 1) < 1e-5);
  }
}

TEST_CASE("a jump takes fewer evaluations with a looser tolerance") {
  INFO(replay_hint());
  DensityCase one{"square", unit_box(2), {2, {}, {}}};
  Random random(test_seed());
  one.seeds = scatter(Distribution::white, 30, 2, {}, random);
  Diagram diagram = diagram_of(one);
  for (const auto& bounds : {std::pair{1e-6, 400'000L}, {0.01, 200'000L}, {0.05, 100'000L}}) {
    const double tolerance = bounds.first;
    const long most = bounds.second;
    std::atomic<long> evaluations{0};
    const auto disk = [&](const std::array<double, 3>& x) {
      ++evaluations;
      return std::hypot(x[0] - 0.5, x[1] - 0.5) < 0.4 ? 3.0 : 1.0;
    };
    const Density jump = Density::function(disk, tolerance);
    (void)jump.total(one.domain);  // cached from here on
    evaluations = 0;
    const DensityIntegrals found = integrate(diagram, jump, false);
    CHECK(std::abs(found.total() / (1 + 2 * 0.16 * std::acos(-1.0)) - 1) < tolerance);
    CAPTURE(tolerance);
    CHECK(evaluations.load() < most);
  }
}

TEST_CASE("values at vertices are integrated exactly") {
  INFO(replay_hint());
  Random shape(7), random(test_seed());
  struct Meshed {
    const char* name;
    Mesh mesh;
    bool solid;
  };
  const Meshed meshed[] = {{"torus", torus(16, 9), false},
                           {"cube_tetrahedra", cube_tetrahedra(2, 0.15, shape), true}};
  for (const Meshed& one_mesh : meshed) {
    const auto& [name, mesh, solid] = one_mesh;
    INFO(one_mesh.name);
    const Domain domain = solid ? volume_of(mesh) : surface_of(mesh);
    DensityCase one{name, domain, seeds_for(domain, Distribution::white, WeightRange::W1, 50, random)};
    std::vector<double> affine, any;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const double* x = &mesh.vertices[3 * v];
      affine.push_back(3 + 0.3 * x[0] + 0.2 * x[1] + 0.4 * x[2]);
      any.push_back(random.uniform(0, 2));
    }
    Diagram diagram = diagram_of(one);
    const DensityIntegrals found = integrate(diagram, Density::nodal(affine), true);
    const DensityIntegrals formula = integrate(diagram, Density::formula("3 + 0.3*x + 0.2*y + 0.4*z"), true);
    check_sums(found, 1e-12);
    for (std::size_t i = 0; i < found.mass.size(); ++i) {
      CHECK(found.mass[i] == doctest::Approx(formula.mass[i]).epsilon(1e-10));
      CHECK(found.second_moment[i] == doctest::Approx(formula.second_moment[i]).epsilon(1e-10));
    }
    REQUIRE(found.walls.neighbor == formula.walls.neighbor);
    CHECK(found.walls.neighbor == diagram.adjacency().neighbor);
    for (std::size_t k = 0; k < found.walls.wall.size(); ++k)
      CHECK(found.walls.wall[k] == doctest::Approx(formula.walls.wall[k]).epsilon(1e-8));
    const DensityIntegrals other = integrate(diagram, Density::nodal(any), false);
    check_sums(other, 1e-12);
    if (solid) check_walls_are_derivatives(one, Density::nodal(any), 1.0);
  }
}

TEST_CASE("an exact density ignores the tolerance") {
  Random shape(7), random(test_seed());
  const Mesh mesh = cube_tetrahedra(2, 0.15, shape);
  std::vector<double> values(mesh.vertex_count());
  for (double& value : values) value = random.uniform(0, 2);
  const Density nodal = Density::nodal(values);
  CHECK(Density::constant(2).is_exact());
  CHECK(nodal.is_exact());
  CHECK_FALSE(Density::formula("1 + x").is_exact());

  DensityCase one{"cube", volume_of(mesh), {}};
  one.seeds = seeds_for(one.domain, Distribution::white, WeightRange::W1, 50, random);
  Diagram diagram = diagram_of(one);
  IntegrationOptions loose;
  loose.tolerance = 0.5;
  CHECK(integrate(diagram, nodal, loose).mass == integrate(diagram, nodal, false).mass);
}

TEST_CASE("integrals in the smallest and largest domains") {
  for (const double unit : {1e-95, 1e-78, 1e78, 1e95}) {
    const std::array<double, 2> low{0, 0}, high{unit, unit};
    const Domain box = Domain::box(low, high);
    CHECK(Density::formula("1").total(box) == doctest::Approx(box.measure()).epsilon(1e-12));
    Diagram diagram(test_device(), box);
    const double positions[]{0.25 * unit, 0.5 * unit, 0.75 * unit, 0.5 * unit};
    diagram.set_seeds({2, positions, {}});
    const DensityIntegrals found = integrate(diagram, Density::formula("1"), true);
    CHECK(found.mass[0] / box.measure() == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(found.walls.wall.at(0) / unit == doctest::Approx(1).epsilon(1e-12));
    const std::vector<double> vertices{0, 0, 0, unit, 0, 0, 0, unit, 0};
    const std::vector<std::uint32_t> triangle{0, 1, 2};
    const Domain surface = Domain::surface(vertices, triangle);
    const std::vector<double> values{0, 3, 0};
    CHECK(Density::nodal(values).total(surface) / surface.measure() == doctest::Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("the number of threads does not change the bits") {
  Random random(test_seed());
  const Domain domain = unit_box(3);
  DensityCase one{"cube", domain, seeds_for(domain, Distribution::white, WeightRange::W1, 300, random)};
  Diagram diagram = diagram_of(one);
  for (const char* formula : {"exp(-x) + y*z", "x + y^2 < z ? 1 + x : 4"}) {
    CAPTURE(formula);
    const Density density = Density::formula(formula, 1e-4);
    const DensityIntegrals single = integrate(diagram, density, true, 1),
                           several = integrate(diagram, density, true, 3);
    CHECK(single.mass == several.mass);
    CHECK(single.second_moment == several.second_moment);
    CHECK(single.walls.wall == several.walls.wall);
  }
}
