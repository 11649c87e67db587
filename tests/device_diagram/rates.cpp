// How fast a device is without the host: run by hand, test_device_diagram -tc='rates*' --no-skip.
// POWERCELL_RATE_SEEDS: how many seeds (10^6).
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "tests/device_diagram/caller.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The least seconds of a few calls, after one that allocates.
template <class Call>
double least_seconds(const Caller& caller, const Call& call) {
  constexpr int runs = 4;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run) {
    REQUIRE(clFinish(caller.queue()) == CL_SUCCESS);
    const auto start = std::chrono::steady_clock::now();
    call();
    REQUIRE(clFinish(caller.queue()) == CL_SUCCESS);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (run > 0) least = std::min(least, seconds);
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
    job.enqueue(diagram, {offset.handle(), neighbor.handle(), wall.handle()});
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
