// How fast a device is without the host: run by hand, test_device_diagram -tc='rates*' --no-skip.
// POWERCELL_RATE_SEEDS: how many seeds (10^6).
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <powercell/diagram.hpp>
#include <powercell/shapes.hpp>

#include "tests/device_diagram/weighted.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of all threads, those of a device on the processor too.
double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// The least seconds of a few calls, after one that allocates. \param now  a clock
template <class Call>
double least_seconds(const Caller& caller, const Call& call, double (*now)() = wall_seconds) {
  constexpr int runs = 4;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    REQUIRE(clFinish(caller.queue()) == CL_SUCCESS);
    const double start = now();
    call();
    REQUIRE(clFinish(caller.queue()) == CL_SUCCESS);
    if (run > 0) least = std::min(least, now() - start);
  }
  return least;
}

std::uint32_t seed_count() {
  const char* set = std::getenv("POWERCELL_RATE_SEEDS");
  return set ? static_cast<std::uint32_t>(std::strtoul(set, nullptr, 10)) : 1000000;
}

void print_rates(Caller& caller, int dimension, WeightRange range, Precision precision) {
  const std::uint32_t n = seed_count();
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, range, n, dimension, random);
  const Domain domain = unit_box(dimension);
  Options options;
  options.precision = precision;
  DeviceDiagram diagram(caller.device(), domain, options);
  const Job job(caller, precision, seeds.view());
  const std::size_t real = precision == Precision::float32 ? sizeof(float) : sizeof(double);
  const std::size_t walls = std::size_t{n} * (dimension == 3 ? 20 : 8);
  const Memory offset(caller, (std::size_t{n} + 1) * sizeof(cl_uint)),
      neighbor(caller, walls * sizeof(cl_uint)), wall(caller, walls * real);
  const double alone = least_seconds(caller, [&] { job.enqueue(diagram); });
  const double with_walls = least_seconds(caller, [&] {
    job.enqueue(diagram, {{offset.handle(), neighbor.handle(), wall.handle()}});
  });
  const Output output = job.read();
  CHECK(output.count(DeviceSeedStatus::unfinished) == 0);
  CHECK(std::abs(output.total() - 1) <= (precision == Precision::float32 ? 1e-6 : 1e-12));
  std::printf("%dD W%d %s, %u seeds: %.3f million cells/s, with adjacency %.3f\n", dimension,
              static_cast<int>(range), precision == Precision::float32 ? "float" : "double", n,
              1e-6 * n / alone, 1e-6 * n / with_walls);
  std::fflush(stdout);
}

}  // namespace

TEST_CASE("rates from device memory to device memory" * doctest::skip()) {
  Caller caller;
  for (const int dimension : {3, 2})
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
      for (const Precision precision : precisions(caller)) print_rates(caller, dimension, range, precision);
}

TEST_CASE("rates of repair beside enqueue and Diagram" * doctest::skip()) {
  Caller caller;
  const std::uint32_t n = seed_count();
  Random random(test_seed());
  Options options;
  options.precision = Precision::float32;
  DeviceDiagram diagram(caller.device(), unit_box(3), options);
  const auto white = [&] {
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, n, 3, random);
    seeds.positions = rounded(seeds.positions, Precision::float32);
    return seeds;
  };
  const SeedArray seeds = white(), others = white();
  const Job job(caller, Precision::float32, seeds.view()), other(caller, Precision::float32, others.view());
  const List list(caller, n), other_list(caller, n);
  const Rows rows(caller, Precision::float32, n, std::size_t{n} * 17),
      other_rows(caller, Precision::float32, n, std::size_t{n} * 17);
  for (const bool walls : {false, true}) {
    const Wanted wanted{walls ? rows.handles() : DeviceAdjacency{}, list.handles()},
        other_wanted{walls ? other_rows.handles() : DeviceAdjacency{}, other_list.handles()};
    Diagram exact(caller.device(), unit_box(3), options);
    const auto seconds = [&](const auto& call) { return least_seconds(caller, call, processor_seconds); };
    const double enqueued = seconds([&] { job.enqueue(diagram, wanted); });
    other.enqueue(diagram, other_wanted);
    int turn = 0;
    const double moved =
        seconds([&] { ++turn % 2 ? job.repair(diagram, wanted) : other.repair(diagram, other_wanted); });
    const double same = seconds([&] { job.repair(diagram, wanted); });
    const double whole = seconds([&] {
      exact.set_seeds(seeds.view());
      exact.compute(walls, false);
    });
    std::printf(
        "%u seeds%s: %u cells; processor seconds: enqueue %.3f, repair %.3f, at the same positions again "
        "%.3f, "
        "Diagram %.3f\n",
        n, walls ? " with adjacency" : "", list.count(), enqueued, moved, same, whole);
    std::fflush(stdout);
  }
}

TEST_CASE("rates of a periodic box beside the same without periods" * doctest::skip()) {
  Caller caller;
  const std::uint32_t n = seed_count();
  for (const int dimension : {3, 2})
    for (const WeightRange range : {WeightRange::W0, WeightRange::W1, WeightRange::W2})
      for (const Precision precision : precisions(caller)) {
        Random random(test_seed());
        const SeedArray seeds = random_seeds(Distribution::white, range, n, dimension, random);
        Options options;
        options.precision = precision;
        const std::vector<double> low(static_cast<std::size_t>(dimension), 0.0), high(low.size(), 1.0);
        DeviceDiagram bounded(caller.device(), Domain::box(low, high), options),
            periodic(caller.device(), Domain::periodic_box(low, high), options);
        const Job job(caller, precision, seeds.view());
        const double alone = least_seconds(caller, [&] { job.enqueue(bounded); });
        const double waiting = least_seconds(caller, [&] { job.enqueue(periodic); });
        periodic.set_image_capacity(n);
        const double with_room = least_seconds(caller, [&] { job.enqueue(periodic); });
        std::printf(
            "%dD W%d %s, %u seeds: bounded %.4f s, periodic %.4f s, with room for an image each %.4f s, "
            "%zu cells unfinished\n",
            dimension, static_cast<int>(range), precision == Precision::float32 ? "float" : "double", n,
            alone, waiting, with_room, job.read().count(DeviceSeedStatus::unfinished));
        std::fflush(stdout);
      }
}

TEST_CASE("rates with a density beside those without, in turns" * doctest::skip()) {
  Caller caller;
  const std::uint32_t n = seed_count();
  const TriangleMesh triangles = sphere(40);
  const TetrahedralMesh tetrahedra = ball(8);
  const NamedDomain domains[] = {
      {"sphere of 32000 triangles", Domain::surface(triangles.vertices, triangles.triangles)},
      {"ball of 4096 tetrahedra", Domain::volume(tetrahedra.vertices, tetrahedra.tetrahedra)}};
  for (const NamedDomain& domain : domains)
    for (const Precision precision : precisions(caller)) {
      Random random(test_seed());
      const SeedArray seeds = seeds_for(domain.domain, Distribution::white, WeightRange::W0, n, random);
      Options options;
      options.precision = precision;
      DeviceDiagram without(caller.device(), domain.domain, options),
          with(caller.device(), domain.domain, options);
      const Reals values(caller, precision, random_values(domain.domain, random));
      with.set_density(values.handle());
      const Job job(caller, precision, seeds.view());
      double alone = std::numeric_limits<double>::infinity(), beside = alone;
      for (int turn = 0; turn < 3; ++turn) {
        alone = std::min(alone, least_seconds(
                                    caller, [&] { job.enqueue(without); }, processor_seconds));
        beside = std::min(beside, least_seconds(
                                      caller, [&] { job.enqueue(with); }, processor_seconds));
      }
      std::printf("%s, %s, %u seeds; processor seconds: measures %.4f, with a density %.4f, ratio %.3f\n",
                  domain.name.c_str(), precision == Precision::float32 ? "float" : "double", n, alone, beside,
                  beside / alone);
      std::fflush(stdout);
    }
}
