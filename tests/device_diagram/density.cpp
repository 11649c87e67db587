// Integrals of a density over cells in device memory.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <powercell/diagram.hpp>
#include <powercell/regions.hpp>

#include "kernels/layout.h"
#include "tests/device_diagram/repaired.hpp"
#include "tests/device_diagram/weighted.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/environment.hpp"

using namespace powercell;
using namespace powercell::test;

static_assert(LARGEST_DENSITY_DOUBLE == Density::largest_value);

namespace {

std::vector<NamedDomain> meshes() {
  std::vector<NamedDomain> all = surface_domains();
  for (const NamedDomain& domain : volume_domains()) all.push_back(domain);
  return all;
}

/// A surface and a volume, each of several regions.
std::vector<NamedDomain> two_meshes() {
  return {surface_domains()[2], volume_domains()[0]};
}

std::size_t count_different(const Output& a, const Output& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.mass.size(); ++i) different += !same_row(a, b, i);
  return different;
}

/// One triangle or tetrahedron around most of the unit cube, so that whole cells lie in it.
Domain one_region(int cell_dimension) {
  const double corners[] = {-2, -2, -2, 8, -2, -2, -2, 8, -2, -2, -2, 8};
  const std::uint32_t corner[] = {0, 1, 2, 3};
  return cell_dimension == 2 ? Domain::surface(std::span(corners).first(9), std::span(corner).first(3))
                             : Domain::volume(corners, corner);
}

/// The same diagram of seeds moved by t: |x - p - t|^2 - w differs from |x - p|^2 - (w - 2 t.p) by a function
/// of x alone.
SeedArray moved(SeedArray seeds, const std::array<double, 3>& t) {
  for (std::size_t i = 0; i < seeds.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const double by = t[static_cast<std::size_t>(k)];
      seeds.weights[i] += 2 * by * seeds.coordinate(i, k);
      seeds.coordinate(i, k) += by;
    }
  return seeds;
}

}  // namespace

TEST_CASE("integrals of a density are those of Density::nodal, on surfaces and in volumes") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const NamedDomain& domain : meshes()) {
      DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
      const std::vector<double> values = rounded(random_values(domain.domain, random), precision);
      const double error = tolerance(precision), largest = *std::max_element(values.begin(), values.end());
      for (const WeightRange weights : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
        for (const std::size_t n : {3u, 250u}) {
          CAPTURE(domain.name);
          CAPTURE(n);
          CAPTURE(name(weights));
          CAPTURE(static_cast<int>(precision));
          const SeedArray seeds =
              rounded_seeds(seeds_for(domain.domain, Distribution::white, weights, n, random), precision);
          const Output found = run_with(caller, diagram, seeds.view(), values);
          const DensityIntegrals expected =
              host_integrals(caller, domain.domain, seeds.view(), values, precision);
          REQUIRE(found.count(DeviceSeedStatus::unfinished) == 0);
          CHECK(differences(found, expected, domain.domain, largest, error) == 0);
          CHECK(std::abs(found.total() - expected.domain_mass) <= error * domain.domain.measure() * largest);
          CHECK(found.count(DeviceSeedStatus::hidden) ==
                run(caller, diagram, seeds.view()).count(DeviceSeedStatus::hidden));
        }
    }
}

TEST_CASE("seeds far outside their cells and outside the domain") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  std::vector<NamedDomain> domains = two_meshes();
  domains.push_back({"triangle", one_region(2)});
  domains.push_back({"tetrahedron", one_region(3)});
  for (const Precision precision : precisions(caller))
    for (const NamedDomain& domain : domains) {
      CAPTURE(domain.name);
      CAPTURE(static_cast<int>(precision));
      DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
      const std::vector<double> values = rounded(random_values(domain.domain, random), precision);
      const double size = domain.domain.high()[0] - domain.domain.low()[0];
      const SeedArray near = seeds_for(domain.domain, Distribution::white, WeightRange::W1, 60, random);
      // At some distances cells in single precision are measured about a point of theirs.
      for (const double far : {0.1 * size, 0.3 * size, size}) {
        CAPTURE(far);
        const SeedArray seeds = rounded_seeds(moved(near, {3 * far, -2 * far, 4 * far}), precision);
        const Output found = run_with(caller, diagram, seeds.view(), values);
        const DensityIntegrals expected =
            host_integrals(caller, domain.domain, seeds.view(), values, precision);
        CHECK(found.count(DeviceSeedStatus::unfinished) == 0);
        // Places are known to the rounding of distances from the seeds.
        CHECK(differences(found, expected, domain.domain, 2, 20 * tolerance(precision)) == 0);
      }
    }
}

TEST_CASE("a constant density is a factor of the measures") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  std::vector<SeededDomain> cases;
  for (const NamedDomain& domain : two_meshes())
    cases.push_back({domain, seeds_for(domain.domain, Distribution::white, WeightRange::W2, 400, random)});
  // Single precision measures cells in the middle of a region about a point of theirs, for lack of digits
  // about the seed.
  const NamedDomain domain_around{"one region, far seeds", one_region(3)};
  cases.push_back({domain_around,
                   moved(seeds_for(domain_around.domain, Distribution::white, WeightRange::W0, 1500, random),
                         {9, 8, 7})});
  for (const Precision precision : precisions(caller))
    for (const auto& [domain, seeds] : cases) {
      CAPTURE(domain.name);
      CAPTURE(domain.domain.cell_dimension());
      CAPTURE(static_cast<int>(precision));
      const double epsilon = precision == Precision::float64 ? 1e-14 : 2e-6;
      DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
      const std::vector<double> values(domain.domain.regions().vertices.size() / 3, 2.5);
      const Output one = run(caller, diagram, seeds.view()),
                   found = run_with(caller, diagram, seeds.view(), values);
      CHECK(found.status == one.status);
      double worst_mass = 0, worst_moment = 0;
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (one.mass[i] > 0) {
          worst_mass = std::max(worst_mass, std::abs(found.mass[i] / one.mass[i] - 2.5));
          worst_moment =
              std::max(worst_moment, std::abs(found.second_moment[i] / one.second_moment[i] - 2.5));
        } else {
          wrong += found.mass[i] != 0 || found.second_moment[i] != 0;
        }
        for (int k = 0; k < 3; ++k) {
          const double a = found.centroid[3 * i + static_cast<std::size_t>(k)],
                       b = one.centroid[3 * i + static_cast<std::size_t>(k)];
          wrong += std::isnan(b) ? !std::isnan(a)
                                 : !(std::abs(a - b) <= epsilon * (8 + std::abs(seeds.coordinate(i, k))));
        }
      }
      CHECK(worst_mass <= epsilon);
      CHECK(worst_moment <= epsilon);
      CHECK(wrong == 0);
    }
}

TEST_CASE("a linear density over a cube has the integrals known in closed form") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  const std::array<double, 3> b{2, 0.5, 3};
  const double a = 0.25, mass = a + (b[0] + b[1] + b[2]) / 2;
  const Domain cube = volume_of(cube_tetrahedra(3, 0.2, random));
  const std::vector<double> values = linear_values(cube, a, b);
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    const double epsilon = precision == Precision::float64 ? 1e-12 : 1e-5;
    DeviceDiagram diagram(caller.device(), cube, in_precision(precision));
    const std::array<double, 3> p{0.3, -1.5, 0.75};
    const Output one = run_with(caller, diagram, SeedArray{3, {p[0], p[1], p[2]}, {0}}.view(), values);
    CHECK(std::abs(one.mass[0] - mass) <= epsilon * mass);
    double second = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double first = mass / 2 + b[k] / 12;  // of x_k, since of (x_k - 1/2)^2 it is 1/12
      CHECK(std::abs(one.centroid[k] - first / mass) <= epsilon);
      second += mass / 3 + b[k] / 12 - 2 * p[k] * first + p[k] * p[k] * mass;
    }
    CHECK(std::abs(one.second_moment[0] - second) <= epsilon * second);

    const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W1, 2000, 3, random);
    const Output many = run_with(caller, diagram, seeds.view(), values);
    std::array<double, 3> first{};
    for (std::size_t i = 0; i < seeds.size(); ++i)
      for (std::size_t k = 0; k < 3 && many.mass[i] > 0; ++k)
        first[k] += many.mass[i] * many.centroid[3 * i + k];
    CHECK(std::abs(many.total() - mass) <= epsilon * mass);
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(std::abs(first[k] - (mass / 2 + b[k] / 12)) <= 10 * epsilon * mass);
  }
}

TEST_CASE("cells where the density is 0 are there, without a centroid") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const NamedDomain& domain : two_meshes()) {
      CAPTURE(domain.name);
      std::vector<double> values = linear_values(domain.domain, -0.5, {1, 0, 0});
      for (double& value : values) value = std::max(value, 0.0);
      DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
      const SeedArray seeds = rounded_seeds(
          seeds_for(domain.domain, Distribution::white, WeightRange::W0, 500, random), precision);
      const Output one = run(caller, diagram, seeds.view()),
                   found = run_with(caller, diagram, seeds.view(), values);
      CHECK(found.status == one.status);
      std::size_t empty = 0, wrong = 0;
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (found.status[i] != DeviceSeedStatus::ok || found.mass[i] != 0) continue;
        ++empty;
        wrong += found.second_moment[i] != 0 || !std::isnan(found.centroid[3 * i]);
      }
      CHECK(empty > 20);
      CHECK(wrong == 0);
      CHECK(differences(found, host_integrals(caller, domain.domain, seeds.view(), values, precision),
                        domain.domain, 1, tolerance(precision)) == 0);
    }
}

TEST_CASE("values that are no densities make the cells of their regions NaN, and no other") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  for (const Precision precision : precisions(caller))
    for (const NamedDomain& domain : two_meshes()) {
      CAPTURE(domain.name);
      DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
      const SeedArray seeds = rounded_seeds(
          seeds_for(domain.domain, Distribution::white, WeightRange::W1, 300, random), precision);
      const std::vector<double> good = rounded(random_values(domain.domain, random), precision);
      const Output expected = run_with(caller, diagram, seeds.view(), good);
      const double large = precision == Precision::float64 ? 1.01e100 : 1.01e30;
      for (const double value : {nan, inf, -inf, -1e-30, large}) {
        CAPTURE(value);
        const std::size_t vertex = random.index(good.size());
        std::vector<double> bad = good, there(good.size(), 0.0);
        bad[vertex] = value;
        there[vertex] = 1;
        const Output found = run_with(caller, diagram, seeds.view(), bad),
                     around = run_with(caller, diagram, seeds.view(), there);
        std::size_t met = 0, wrong = 0;
        for (std::size_t i = 0; i < seeds.size(); ++i) {
          const bool meets = around.mass[i] > 0;
          met += meets;
          const bool all_nan = std::isnan(found.mass[i]) && std::isnan(found.centroid[3 * i]) &&
                               std::isnan(found.centroid[3 * i + 2]) && std::isnan(found.second_moment[i]);
          wrong += found.status[i] != expected.status[i] || !(meets ? all_nan : same_row(found, expected, i));
        }
        CHECK(met > 0);
        CHECK(met < seeds.size());
        CHECK(wrong == 0);
      }
      // The largest density is one, and so is -0.
      std::vector<double> most(good.size(), -0.0);
      most[0] = precision == Precision::float64 ? 1e100 : 1e30;
      const Output found = run_with(caller, diagram, seeds.view(), most);
      CHECK(std::all_of(found.mass.begin(), found.mass.end(), [](double m) { return m >= 0 && m <= 1e100; }));
    }
}

TEST_CASE("values that change in device memory are read anew, and none means 1 again") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  const NamedDomain domain = two_meshes()[0];
  DeviceDiagram diagram(caller.device(), domain.domain);
  const SeedArray seeds = seeds_for(domain.domain, Distribution::white, WeightRange::W0, 200, random);
  const std::vector<double> first = random_values(domain.domain, random),
                            second = random_values(domain.domain, random);
  const Output uniform = run(caller, diagram, seeds.view()),
               with_first = run_with(caller, diagram, seeds.view(), first),
               with_second = run_with(caller, diagram, seeds.view(), second);
  CHECK(count_different(with_first, with_second) > 100);
  {
    const Reals memory(caller, diagram.precision(), first);
    diagram.set_density(memory.handle());
    CHECK(count_different(run(caller, diagram, seeds.view()), with_first) == 0);
    memory.write(caller.queue(), second);
  }
  // The caller has released the buffer, which the diagram retains, wherever it is moved.
  DeviceDiagram other = std::move(diagram);
  CHECK(count_different(run(caller, other, seeds.view()), with_second) == 0);
  // Work in the queue keeps what it needs when another density is set.
  const Job job(caller, other.precision(), seeds.view());
  job.enqueue(other);
  other.set_density(nullptr);
  CHECK(count_different(job.read(), with_second) == 0);
  CHECK(count_different(run(caller, other, seeds.view()), uniform) == 0);
}

TEST_CASE("what else is asked for is as without a density") {
  INFO(replay_hint());
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const NamedDomain& domain : two_meshes()) {
    CAPTURE(domain.name);
    DeviceDiagram diagram(caller.device(), domain.domain);
    const std::size_t n = 300, room = 20000;
    const SeedArray seeds = seeds_for(domain.domain, Distribution::white, WeightRange::W1, n, random);
    const std::vector<double> values = random_values(domain.domain, random);
    const Output masses = run_with(caller, diagram, seeds.view(), values);
    const Job job(caller, diagram.precision(), seeds.view());
    const Rows rows(caller, diagram.precision(), n, room), rows_with(caller, diagram.precision(), n, room);
    const BoundaryRows parts(caller, diagram.precision(), n, room),
        parts_with(caller, diagram.precision(), n, room);
    const List list(caller, n), list_with(caller, n);
    job.enqueue(diagram, {rows.handles(), list.handles(), {}, parts.handles()});
    const Output one = job.read();
    const Reals memory(caller, diagram.precision(), values);
    diagram.set_density(memory.handle());
    job.enqueue(diagram, {rows_with.handles(), list_with.handles(), {}, parts_with.handles()});
    CHECK(count_different(job.read(), masses) == 0);
    CHECK(masses.status == one.status);
    CHECK(rows_with.read().offset == rows.read().offset);
    CHECK(rows_with.read().neighbor == rows.read().neighbor);
    CHECK(rows_with.read().wall == rows.read().wall);
    CHECK(parts_with.read().facet == parts.read().facet);
    CHECK(parts_with.read().measure == parts.read().measure);
    CHECK(list_with.read() == list.read());
  }
}

TEST_CASE("cells of many faces, small launches and few pairs") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller)) {
    CAPTURE(static_cast<int>(precision));
    for (const Domain& domain : {one_region(2), one_region(3)}) {
      // The cell of the last seed has more faces than the smaller capacity.
      CAPTURE(domain.cell_dimension());
      SeedArray seeds = cospherical(100, domain.cell_dimension());
      if (domain.cell_dimension() == 2) {
        SeedArray plane{3, {}, seeds.weights};
        for (std::size_t i = 0; i < seeds.size(); ++i)
          plane.positions.insert(plane.positions.end(), {seeds.coordinate(i, 0), seeds.coordinate(i, 1), -2});
        seeds = plane;
        seeds.push({0.5, 0.5, -2}, 0);
      } else {
        for (double& x : seeds.positions) x += random.uniform(-1e-3, 1e-3);
        seeds.push({0.5, 0.5, 0.5}, 0);
      }
      seeds = rounded_seeds(seeds, precision);
      const std::vector<double> values(linear_values(domain, 2.5, {0.5, 0.125, 0.25}));
      DeviceDiagram diagram(caller.device(), domain, in_precision(precision));
      const Output found = run_with(caller, diagram, seeds.view(), values);
      REQUIRE(found.status.back() == DeviceSeedStatus::ok);
      const DensityIntegrals expected = host_integrals(caller, domain, seeds.view(), values, precision);
      CHECK(std::abs(found.mass.back() - expected.mass.back()) <=
            tolerance(precision) * expected.mass.back());
      for (std::size_t k = 300; k < 303; ++k)
        CHECK(std::abs(found.centroid[k] - expected.centroid[k]) <= tolerance(precision));
      CHECK(std::abs(found.second_moment.back() - expected.second_moment.back()) <=
            10 * tolerance(precision) * expected.second_moment.back());
    }
  }
  const NamedDomain domain = two_meshes()[1];
  const SeedArray seeds = seeds_for(domain.domain, Distribution::white, WeightRange::W1, 700, random);
  const std::vector<double> values = random_values(domain.domain, random);
  Options options;
  options.chunk_pairs = 333;
  DeviceDiagram whole(caller.device(), domain.domain), chunked(caller.device(), domain.domain, options);
  const Output all = run_with(caller, whole, seeds.view(), values);
  CHECK(count_different(run_with(caller, chunked, seeds.view(), values), all) == 0);
  whole.set_pair_capacity(600);
  const Output some = run_with(caller, whole, seeds.view(), values);
  const std::size_t unfinished = some.count(DeviceSeedStatus::unfinished);
  CHECK(unfinished > 0);
  CHECK(unfinished < 700);
  for (std::size_t i = 0; i < seeds.size(); ++i)
    CHECK(
        (some.status[i] == DeviceSeedStatus::unfinished ? std::isnan(some.mass[i]) : same_row(some, all, i)));
}

TEST_CASE("lanes at once and one by one give the same masses") {
  Caller& caller = shared_caller();
  Random random(test_seed());
  for (const Precision precision : precisions(caller))
    for (const NamedDomain& domain : two_meshes()) {
      // Each width is compiled anew, which takes long in space.
      if (domain.domain.cell_dimension() == 3 && precision == Precision::float64 && !all_inputs()) continue;
      CAPTURE(domain.name);
      CAPTURE(static_cast<int>(precision));
      const SeedArray seeds = seeds_for(domain.domain, Distribution::white, WeightRange::W1, 500, random);
      const std::vector<double> values = random_values(domain.domain, random);
      std::vector<Output> outputs;
      for (const char* width : {"1", "8"}) {
        const Environment lanes("POWERCELL_LANES", width);
        DeviceDiagram diagram(caller.device(), domain.domain, in_precision(precision));
        outputs.push_back(run_with(caller, diagram, seeds.view(), values));
      }
      CHECK(count_different(outputs[0], outputs[1]) == 0);
    }
}
