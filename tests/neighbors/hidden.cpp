// Seeds known to be hidden before any cell is clipped: each of them must be, and most of the hidden ones must
// be found.
#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "lib/neighbors/hidden_seeds.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

struct Found {
  std::size_t found = 0, hidden = 0;
};

/// Checks that what is found is hidden by definition; counts.
Found check_found(const Domain& domain, const SeedArray& input, bool float32) {
  const SeedSet seeds = make_seed_set(input.view(), domain.dimension(), 1);
  const PackedTree tree = build_packed_tree(seeds, 1);
  Scene scene(main_setups().front().device.context(), domain.mesh(), float32);
  scene.set_seeds(seeds, tree);
  const std::vector<std::uint8_t> hidden = hidden_seeds(scene);
  REQUIRE(hidden.size() == seeds.size());
  const ReferenceDiagram reference = brute_force(domain.mesh(), input.view());
  Found count;
  for (std::size_t rank = 0; rank < hidden.size(); ++rank) {
    const std::uint32_t i = seeds.input[rank];
    CAPTURE(i);
    if (hidden[rank]) REQUIRE(reference.mass[i] == 0);
    count.found += hidden[rank];
    count.hidden += reference.mass[i] > 0 ? 0 : 1;
  }
  const SeedSet rest = without_hidden(seeds, hidden, 2);
  CHECK(rest.size() == seeds.size() - count.found);
  CHECK(std::is_sorted(rest.input.begin(), rest.input.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::find(seeds.input.begin(), seeds.input.end(), a) <
           std::find(seeds.input.begin(), seeds.input.end(), b);
  }));
  return count;
}

template <class Body>
void for_each_precision(const Body& body) {
  INFO(replay_hint());
  for (const bool float32 : {false, true})
    for (const int d : {2, 3}) {
      CAPTURE(float32);
      CAPTURE(d);
      body(d, float32);
    }
}

}  // namespace

TEST_CASE("hidden seeds: most are found among random weights, and no others") {
  for_each_precision([](int d, bool float32) {
    for (const Distribution distribution : {Distribution::white, Distribution::blue, Distribution::cluster})
      for (const WeightRange weights : {WeightRange::W1, WeightRange::W2}) {
        INFO(name(distribution) << " " << name(weights));
        Random random(test_seed());
        const SeedArray seeds = random_seeds(distribution, weights, 250, d, random);
        const Found count = check_found(unit_box(d), seeds, float32);
        if (weights == WeightRange::W2) CHECK(2 * count.found > count.hidden);
      }
  });
}

TEST_CASE("hidden seeds: one that hides all others, and weights that grow from side to side") {
  for_each_precision([](int d, bool float32) {
    Random random(test_seed());
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W0, 300, d, random);
    seeds.weights[33] = 100;
    const Found count = check_found(unit_box(d), seeds, float32);
    CHECK(count.hidden == 299);
    CHECK(count.found == 299);
    for (std::size_t i = 0; i < seeds.size(); ++i) seeds.weights[i] = seeds.coordinate(i, 0);
    check_found(unit_box(d), seeds, float32);
  });
}

TEST_CASE("hidden seeds: a cell of one point, or none by the least, is left to exact decisions") {
  for_each_precision([](int d, bool float32) {
    // A seed in the middle of each square or cube of a lattice, of a weight that leaves it a corner of all
    // others.
    const int side = 4;  // a power of two: positions and weights are exact
    SeedArray seeds = grid(static_cast<std::size_t>(side), d);
    const std::size_t corners = seeds.size();
    const double step = 1.0 / side;
    for (std::size_t i = 0; i < corners; ++i) {
      bool inside = true;
      for (int k = 0; k < d; ++k) inside = inside && seeds.coordinate(i, k) + step < 1;
      if (!inside) continue;
      seeds.positions.insert(seeds.positions.end(), &seeds.positions[i * static_cast<std::size_t>(d)],
                             &seeds.positions[(i + 1) * static_cast<std::size_t>(d)]);
      for (int k = 0; k < d; ++k)
        seeds.positions[seeds.positions.size() - 1 - static_cast<std::size_t>(k)] += step / 2;
      seeds.weights.push_back(-d * step * step / 4);
    }
    REQUIRE(seeds.size() > corners);
    CHECK(check_found(unit_box(d), seeds, float32).found == 0);
    for (std::size_t i = corners; i < seeds.size(); ++i) seeds.weights[i] *= 0.99;
    CHECK(check_found(unit_box(d), seeds, float32).found == 0);
    for (std::size_t i = corners; i < seeds.size(); ++i) seeds.weights[i] *= 1.02;
    CHECK(10 * check_found(unit_box(d), seeds, float32).found > 9 * (seeds.size() - corners));
  });
}

TEST_CASE("hidden seeds: numbers at the ends of their range") {
  for_each_precision([](int d, bool float32) {
    Random random(test_seed());
    for (const double scale : {1e-9, 1.0, 1e9})
      for (const double weight : {1e-12, 1e6, 1e25}) {
        CAPTURE(scale);
        CAPTURE(weight);
        SeedArray seeds = random_seeds(Distribution::white, WeightRange::W2, 200, d, random);
        for (double& x : seeds.positions) x *= scale;
        for (std::size_t i = 0; i < seeds.size(); ++i)
          seeds.weights[i] *= scale * scale * (i % 7 == 0 ? weight : 1);
        for (std::size_t i = 0; i < seeds.size(); i += 5) seeds.coordinate(i, 0) += 1e4 * scale;
        check_found(Domain::box(std::vector<double>(static_cast<std::size_t>(d), 0.0),
                                std::vector<double>(static_cast<std::size_t>(d), scale)),
                    seeds, float32);
      }
  });
}
