// How many runs are enough, how they scatter, and which rows there are.
#include <doctest/doctest.h>

#include <algorithm>

#include "apps/bench/repeated.hpp"
#include "apps/bench/sizes.hpp"

using namespace powercell::app;

namespace {

/// The runs that are made where these are what they would take, again and again.
TimedRuns made(const std::vector<double>& seconds, const RunLimits& limits) {
  TimedRuns runs;
  while (!enough(runs, limits)) runs.seconds.push_back(seconds[runs.seconds.size() % seconds.size()]);
  return runs;
}

}  // namespace

TEST_CASE("runs scatter by how much longer their lower quartile takes than the best") {
  CHECK(TimedRuns{{2}, {}}.scatter() == 0);
  CHECK(TimedRuns{{}, {}}.scatter() == 0);
  CHECK(TimedRuns{{3, 2}, {}}.scatter() == doctest::Approx(0.5));
  CHECK(TimedRuns{{9, 2, 2.2}, {}}.scatter() == doctest::Approx(0.1));  // of three the middle one
  CHECK(TimedRuns{{9, 2, 9, 9, 2.1, 2.2, 9, 2.4, 9}, {}}.scatter() == doctest::Approx(0.2));
}

TEST_CASE("runs end when a quarter of them are close to the best") {
  CHECK(made({0.1}, {0, 20}).seconds.size() == 9);
  CHECK(made({0.01}, {0, 20}).seconds.size() == 20);  // a fifth of a second at least
  // A quarter is calm: as many as it takes, however long the others take.
  const TimedRuns calm = made({0.1, 0.104, 0.4, 0.4, 0.4, 0.4, 0.102, 0.4}, {0, 20});
  CHECK(calm.scatter() <= settled_scatter);
  CHECK(calm.seconds.size() < 20);
}

TEST_CASE("runs that do not settle end when time is over, and there are three in any case") {
  const TimedRuns wild = made({0.1, 0.15, 0.2, 0.3, 0.12, 0.14, 0.18}, {0, 5});
  CHECK(wild.scatter() > settled_scatter);
  CHECK(wild.spent() > 4.6);
  CHECK(wild.spent() <= 5 + 0.2);
  CHECK(made({7}, {0, 5}).seconds.size() == 3);
  CHECK(made({2}, {0, 7}).seconds.size() == 3);  // a fourth would end at 8 s
}

TEST_CASE("a number of runs that is asked for is kept") {
  CHECK(made({0.1}, {1, 20}).seconds.size() == 1);
  CHECK(made({0.1, 0.9}, {40, 1}).seconds.size() == 40);
}

TEST_CASE("rows have fixed sizes, and those of --quick are among the others") {
  using Sizes = std::vector<std::size_t>;
  CHECK(row_sizes("cube", false) == Sizes{10'000, 100'000, 1'000'000});
  CHECK(row_sizes("square", false) == Sizes{10'000, 100'000});
  for (const char* domain : {"cube", "square", "part.mesh"})
    for (const std::size_t n : row_sizes(domain, true)) {
      const Sizes all = row_sizes(domain, false);
      CHECK(std::count(all.begin(), all.end(), n) == 1);
    }
}

TEST_CASE("rows that a device cannot take are left out with the reason") {
  const std::uint64_t giga = 1'000'000'000;
  CHECK(why_left_out(1'000'000, 16 * giga, 0) == "");
  CHECK(why_left_out(1'000'000, 16 * giga, 200'000) == "");
  CHECK(why_left_out(1'000'000, 2 * giga, 0).find("2.5 GB of device memory, and there are 2.0") !=
        std::string::npos);
  CHECK(why_left_out(1'000'000, 16 * giga, 10'000) == "each run would take about 100 s");
}

TEST_CASE("transfers are measured from 4 KiB to 256 MiB") {
  const auto sizes = transfer_sizes();
  REQUIRE(sizes.size() == 9);
  CHECK(bytes_text(sizes.front()) == "4 KiB");
  CHECK(bytes_text(sizes[4]) == "1 MiB");
  CHECK(bytes_text(sizes.back()) == "256 MiB");
}
