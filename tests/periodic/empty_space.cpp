// Periodic domains of which most is empty: seeds inside a droplet, a slab or a cluster have no images.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/periodic/brute_force.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr double edge = 10;

void add_droplet(SeedArray& seeds, const std::array<double, 3>& middle, double radius, std::size_t n,
                 Random& random) {
  while (n > 0) {
    std::array<double, 3> u{};
    double square = 0;
    for (double& x : u) {
      x = 2 * random.uniform() - 1;
      square += x * x;
    }
    if (square > 1) continue;
    for (std::size_t c = 0; c < 3; ++c) seeds.positions.push_back(middle[c] + radius * u[c]);
    --n;
  }
}

/// Seeds with copies one period to each side, and the box of all of them: the middle ones, which come first,
/// have the cells of the periodic domain.
SeedArray with_copies(const SeedArray& seeds) {
  SeedArray all = seeds;
  for (int s = 0; s < 27; ++s) {
    if (s == 13) continue;
    for (std::size_t k = 0; k < seeds.positions.size(); ++k) {
      const int shift[3] = {s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1};
      all.positions.push_back(seeds.positions[k] + shift[k % 3] * edge);
    }
    all.weights.insert(all.weights.end(), seeds.weights.begin(), seeds.weights.end());
  }
  return all;
}

void check_against_copies(const SeedArray& seeds) {
  const double low[3] = {-edge, -edge, -edge}, high[3] = {2 * edge, 2 * edge, 2 * edge};
  const double zero[3] = {0, 0, 0}, one[3] = {edge, edge, edge};
  const SeedArray copies = with_copies(seeds);
  for (const Setup& setup : main_setups()) {
    INFO(setup.name << ", " << seeds.size() << " seeds");
    Diagram among(setup.device, Domain::box(low, high), setup.options);
    among.set_seeds(copies.view());
    Diagram periodic(setup.device, Domain::periodic_box(zero, one), setup.options);
    periodic.set_seeds(seeds.view());
    const Measures &expected = among.measures(), &found = periodic.measures();
    const Adjacency &walls = among.adjacency(), &periodic_walls = periodic.adjacency();
    double sum = 0;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      sum += found.mass[i];
      REQUIRE(std::abs(found.mass[i] - expected.mass[i]) <= 1e-9 * (edge + expected.mass[i]));
      REQUIRE(periodic_walls.offset[i + 1] - periodic_walls.offset[i] ==
              walls.offset[i + 1] - walls.offset[i]);
    }
    CHECK(std::abs(sum / std::pow(edge, 3) - 1) < 1e-12);
  }
}

}  // namespace

TEST_CASE("droplets, slabs, voids and clusters in periodic boxes are those among copies") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray droplet, slab, clusters, hollow;
  add_droplet(droplet, {5, 5, 5}, 1, 400, random);
  for (std::size_t k = 0; k < 400; ++k)
    for (const double thick : {edge, edge, 1.0}) slab.positions.push_back(thick * random.uniform());
  for (int k = 0; k < 6; ++k)
    add_droplet(clusters, {edge * random.uniform(), edge * random.uniform(), edge * random.uniform()},
                0.1 + 0.4 * random.uniform(), 60, random);
  for (double& x : clusters.positions) x -= edge * std::floor(x / edge);
  while (hollow.size() < 400) {
    std::array<double, 3> x{};
    for (double& value : x) value = edge * random.uniform();
    if (std::hypot(x[0] - 5, x[1] - 5, x[2] - 5) > 4)
      hollow.positions.insert(hollow.positions.end(), x.begin(), x.end());
  }
  for (SeedArray* seeds : {&droplet, &slab, &clusters, &hollow}) {
    seeds->weights.assign(seeds->size(), 0);
    check_against_copies(*seeds);
    for (double& w : seeds->weights) w = 0.01 * random.uniform();
    check_against_copies(*seeds);
    seeds->weights[7] = 4;  // which reaches far and hides others
    check_against_copies(*seeds);
  }
}

TEST_CASE("a selection of a droplet's cells has the bits of the whole") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds;
  add_droplet(seeds, {5, 5, 5}, 1, 1000, random);
  seeds.weights.assign(seeds.size(), 0);
  const double zero[3] = {0, 0, 0}, one[3] = {edge, edge, edge};
  for (const Setup& setup : main_setups()) {
    Diagram diagram(setup.device, Domain::periodic_box(zero, one), setup.options);
    diagram.set_seeds(seeds.view());
    const std::vector<double> whole = diagram.measures().mass;
    std::vector<std::uint32_t> some;
    for (std::uint32_t i = 0; i < seeds.size(); i += 3) some.push_back(i);
    diagram.select(some);
    for (std::size_t k = 0; k < some.size(); ++k) CHECK(diagram.measures().mass[k] == whole[some[k]]);
    diagram.select_all();
    // New weights need other images.
    for (double& w : seeds.weights) w = 0.02 * random.uniform();
    diagram.set_weights(seeds.weights);
    Diagram fresh(setup.device, Domain::periodic_box(zero, one), setup.options);
    fresh.set_seeds(seeds.view());
    CHECK(diagram.measures().mass == fresh.measures().mass);
    CHECK(diagram.adjacency().neighbor == fresh.adjacency().neighbor);
  }
}
