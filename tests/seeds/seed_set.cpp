#include "lib/seeds/seed_set.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <powercell/error.hpp>
#include <string>

#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

void check_refused(const SeedsView& seeds, int dimension, ErrorCode code, const std::string& part) {
  try {
    make_seed_set(seeds, dimension, 2);
    FAIL("not refused: ", part);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    const std::string message = error.what();
    CHECK_MESSAGE(message.find(part) != std::string::npos, message);
  }
}

}  // namespace

TEST_CASE("positions and weights are those given, by rank") {
  INFO(replay_hint());
  for (const int d : {2, 3})
    for (const std::size_t n : {1, 2, 7, 8, 9, 1000, 70000}) {
      Random random(test_seed());
      const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, n, d, random);
      const SeedSet set = make_seed_set(seeds.view(), d, 2);
      REQUIRE(set.size() == n);
      CHECK(set.input_count == n);
      CHECK(set.duplicate.empty());
      CHECK(set.dimension == d);
      std::vector<bool> seen(n);
      for (std::size_t rank = 0; rank < n; ++rank) {
        const std::uint32_t i = set.input[rank];
        REQUIRE(!seen[i]);
        seen[i] = true;
        for (int k = 0; k < d; ++k)
          REQUIRE(set.positions[rank * static_cast<std::size_t>(d) + static_cast<std::size_t>(k)] ==
                  seeds.coordinate(i, k));
        REQUIRE(set.weights[rank] == seeds.weights[i]);
      }
    }
}

TEST_CASE("missing weights are zero, and an empty set is valid") {
  const std::vector<double> positions = {0, 0, 1, 1, 2, 0};
  CHECK(make_seed_set({2, positions, {}}, 2, 1).weights == std::vector<double>(3, 0.0));
  const SeedSet none = make_seed_set({3, {}, {}}, 3, 4);
  CHECK(none.size() == 0);
  CHECK(none.positions.empty());
}

TEST_CASE("of equal positions the largest weight stays, then the lowest index") {
  INFO(replay_hint());
  for (const int d : {2, 3}) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 4000, d, random);
    std::map<std::vector<double>, std::uint32_t> winner;
    for (std::uint32_t i = 0; i < seeds.size(); ++i) {
      std::vector<double> position;
      for (int k = 0; k < d; ++k) {
        const double x = static_cast<double>(random.index(10)) - 5;
        seeds.coordinate(i, k) = x == 0 && random.index(2) == 0 ? -0.0 : x;
        position.push_back(x);  // -0.0 and 0.0 are equal keys of the map too
      }
      seeds.weights[i] = static_cast<double>(random.index(4)) - 2;
      const auto [at, is_new] = winner.try_emplace(position, i);
      if (!is_new && seeds.weights[i] > seeds.weights[at->second]) at->second = i;
    }
    const SeedSet set = make_seed_set(seeds.view(), d, 3);
    std::vector<std::uint32_t> kept = set.input, expected;
    for (const auto& [position, i] : winner) expected.push_back(i);
    std::sort(kept.begin(), kept.end());
    std::sort(expected.begin(), expected.end());
    CHECK(kept == expected);
    CHECK(set.duplicate.size() + set.size() == seeds.size());
    CHECK(std::is_sorted(set.duplicate.begin(), set.duplicate.end()));
    for (const std::uint32_t i : set.duplicate) CHECK(!std::binary_search(kept.begin(), kept.end(), i));
  }
}

TEST_CASE("of seeds that are all at one position one stays") {
  std::vector<double> positions(3 * 200000, 1.5), weights(200000, -1.0);
  weights[77] = weights[99] = 2;
  const SeedSet set = make_seed_set({3, positions, weights}, 3, 2);
  CHECK(set.input == std::vector<std::uint32_t>{77});
  CHECK(set.weights == std::vector<double>{2});
  CHECK(set.duplicate.size() == 199999);
}

TEST_CASE("the set does not depend on the number of threads") {
  INFO(replay_hint());
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W1, 200000, 3, random);
  const SeedSet one = make_seed_set(seeds.view(), 3, 1);
  for (const int threads : {2, 5, 0}) {
    const SeedSet set = make_seed_set(seeds.view(), 3, threads);
    CHECK(set.input == one.input);
    CHECK(set.positions == one.positions);
    CHECK(set.weights == one.weights);
  }
}

TEST_CASE("invalid seeds are refused, with the index and the value") {
  const std::vector<double> good = {0, 0, 1, 1, 2, 2};
  check_refused({3, good, {}}, 2, ErrorCode::invalid_argument, "3 coordinates");
  check_refused({4, good, {}}, 4, ErrorCode::invalid_argument, "2 or 3");
  check_refused({2, std::span(good).first(5), {}}, 2, ErrorCode::invalid_argument, "multiple");
  check_refused({2, good, std::span(good).first(2)}, 2, ErrorCode::invalid_argument, "2 weights for 3 seeds");

  std::vector<double> positions(3 * 100000, 0.0), weights(100000, 0.0);
  positions[3 * 71234 + 1] = nan_value;
  positions[3 * 91234 + 2] = infinite;
  check_refused({3, positions, weights}, 3, ErrorCode::invalid_seed, "seed 71234: coordinate y is NaN");
  weights[60000] = -infinite;
  check_refused({3, positions, weights}, 3, ErrorCode::invalid_seed, "seed 60000: weight is -infinity");
  weights[60000] = 0;
  positions[3 * 71234 + 1] = 0;
  check_refused({3, positions, weights}, 3, ErrorCode::invalid_seed, "seed 91234: coordinate z is infinity");
}
