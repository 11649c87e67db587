// What seeds in shards are refused for.
#include <doctest/doctest.h>

#include <limits>
#include <powercell/error.hpp>

#include "tests/exchange/compare.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::string refusal_of_one(const SeedArray& seeds) {
  Diagram diagram(test_device(), unit_box(seeds.dimension));
  try {
    diagram.set_seeds(seeds.view());
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::invalid_seed);
    return error.what();
  }
  return "";
}

std::string refusal_of_shards(const Domain& domain, const std::vector<exchange::ShardSeeds>& shards,
                              ErrorCode code, const Options& options = {}) {
  try {
    exchange::compute_shards(test_device(), domain, shards, options);
  } catch (const Error& error) {
    CHECK(error.code() == code);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("shards: a bad seed is refused as in one diagram, by its id") {
  Random random(test_seed());
  const SeedArray good = random_seeds(Distribution::white, WeightRange::W1, 60, 3, random);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  struct Bad {
    std::size_t seed;
    int coordinate;  // 3: weight
    double value;
  };
  for (const std::vector<Bad>& faults :
       std::vector<std::vector<Bad>>{{{41, 1, nan}},
                                     {{40, 3, infinity}, {17, 0, nan}},
                                     {{3, 2, 1e200}},
                                     {{3, 3, 1e300}, {50, 1, -1e200}, {51, 0, 1e200}},
                                     {{3, 1, 1e200}, {50, 3, -infinity}}}) {
    SeedArray seeds = good;
    for (const Bad& bad : faults)
      (bad.coordinate == 3 ? seeds.weights[bad.seed] : seeds.coordinate(bad.seed, bad.coordinate)) =
          bad.value;
    const std::string expected = refusal_of_one(seeds);
    REQUIRE(!expected.empty());
    for (const std::size_t count : {1, 4}) {
      const Shares shares = at_random(seeds, count, random);
      CHECK(refusal_of_shards(unit_box(3), shares.view(), ErrorCode::invalid_seed) == expected);
    }
  }
}

TEST_CASE("shards: ids in any order") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 60, 3, random);
  Shares shares = at_random(seeds, 1, random);
  std::reverse(shares.ids[0].begin(), shares.ids[0].end());
  shares.positions[0][0] = shares.positions[0][30] = std::numeric_limits<double>::quiet_NaN();
  CHECK(contains(refusal_of_shards(unit_box(3), shares.view(), ErrorCode::invalid_seed),
                 "seed 49: coordinate x"));
  shares.positions[0][0] = 0.5;
  shares.positions[0][30] = 0.6;
  const exchange::ShardedDiagram sharded =
      exchange::compute_shards(test_device(), unit_box(3), shares.view());
  Diagram diagram(test_device(), unit_box(3));
  diagram.set_seeds({3, shares.positions[0], shares.weights[0]});
  for (std::size_t k = 0; k < seeds.size(); ++k)
    CHECK(sharded.shards[0].measures.mass[k] == doctest::Approx(diagram.measures().mass[k]));
  CHECK(sharded.shards[0].neighbor[0] < seeds.size());
}

TEST_CASE("shards: ids that are there twice, and sizes that do not match") {
  Random random(test_seed());
  const SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 20, 2, random);
  Shares shares = at_random(seeds, 3, random);
  shares.ids[2].back() = shares.ids[0].front();
  CHECK(contains(refusal_of_shards(unit_box(2), shares.view(), ErrorCode::invalid_argument),
                 "two seeds have the id " + std::to_string(shares.ids[0].front())));
  shares = at_random(seeds, 3, random);
  shares.ids[1].pop_back();
  CHECK(contains(refusal_of_shards(unit_box(2), shares.view(), ErrorCode::invalid_argument), "ids for"));
  CHECK(contains(
      refusal_of_shards(unit_box(3), at_random(seeds, 3, random).view(), ErrorCode::invalid_argument),
      "coordinates each"));
}

TEST_CASE("shards: seeds too far outside a periodic domain are refused as in one diagram, by their ids") {
  const Domain domain = Domain::periodic_box(std::array{0.0, 0.0, 0.0}, std::array{1.0, 1.0, 1.0});
  Random random(test_seed());
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, 60, 3, random);
  seeds.coordinate(50, 1) = 1e9;
  seeds.coordinate(31, 2) = -1e9;
  Diagram diagram(test_device(), domain);
  std::string expected;
  try {
    diagram.set_seeds(seeds.view());
  } catch (const Error& error) {
    expected = error.what();
  }
  CHECK(contains(expected, "seed 31: it is more than 2^28 periods outside"));
  CHECK(refusal_of_shards(domain, at_random(seeds, 3, random).view(), ErrorCode::invalid_seed) == expected);
}

TEST_CASE("shards: domains and options that they cannot have") {
  const Mesh ball = icosphere(0);
  for (const Domain& domain : {surface_of(ball), Domain::solid(ball.vertices, ball.elements)})
    CHECK(
        contains(refusal_of_shards(domain, {}, ErrorCode::unsupported), "need a polygon, a box or a volume"));
  Options options;
  options.certify = true;
  CHECK(contains(refusal_of_shards(unit_box(3), {}, ErrorCode::unsupported, options), "certify"));
  options = {};
  options.decisions = Decisions::fast;
  CHECK(contains(refusal_of_shards(unit_box(3), {}, ErrorCode::unsupported, options), "exact decisions"));
  options = {};
  options.precision = Precision::float32;
  CHECK(contains(refusal_of_shards(unit_box(3), {}, ErrorCode::unsupported, options), "double precision"));
}
