// Seeds in small parts of the domain: clusters of any width, mixtures of them and even seeds.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/applications/transport/cases.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr std::size_t most_diagrams = 60;

/// n seeds in a cube of this width about a point.
void add_cluster(SeedArray& seeds, const std::vector<double>& about, double width, std::size_t n,
                 Random& random) {
  for (std::size_t i = 0; i < n; ++i)
    for (const double x : about) seeds.positions.push_back(x + width * (random.uniform() - 0.5));
}

std::vector<double> random_place(int d, Random& random) {
  std::vector<double> place;
  for (int c = 0; c < d; ++c) place.push_back(0.05 + 0.9 * random.uniform());
  return place;
}

/// Solves, and compares the masses with those of another diagram of the weights.
void check_solved(const Domain& domain, const SeedArray& seeds, const std::vector<double>& masses = {},
                  std::size_t most = most_diagrams) {
  const TransportResult found =
      transport(transport_device(), domain, seeds.view(), masses, transport_options());
  INFO(found.diagrams << " diagrams, error " << found.error << ", rounding " << found.rounding_error);
  REQUIRE(found.converged);
  CHECK(found.diagrams <= most);
  Diagram diagram(transport_device(), domain, transport_options().diagram);
  diagram.set_seeds({seeds.dimension, seeds.positions, found.weights});
  const double allowed = std::max(1e-6, found.rounding_error);
  for (std::size_t i = 0; i < found.mass.size(); ++i)
    REQUIRE(std::abs(diagram.measures().mass[i] / found.target[i] - 1) <= 2 * allowed);
}

SeedArray empty_seeds(int d) {
  SeedArray seeds;
  seeds.dimension = d;
  return seeds;
}

}  // namespace

TEST_CASE("seeds in a small part of the domain, alone and beside even ones") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3})
    for (const double width : {1e-2, 1e-3, 1e-5, 1e-7, 1e-9})
      for (const std::size_t even : {0u, 200u}) {
        INFO(d << "D, width " << width << ", " << even << " even seeds");
        SeedArray seeds = empty_seeds(d);
        add_cluster(seeds, random_place(d, random), width, 200, random);
        add_cluster(seeds, std::vector<double>(static_cast<std::size_t>(d), 0.5), 1, even, random);
        check_solved(unit_box(d), seeds);
        // Weights in double precision cannot meet the least masses of the narrowest clusters.
        if (width >= 1e-5)
          check_solved(unit_box(d), seeds, random_masses(200 + even, 1e6, 1, random), 2 * most_diagrams);
      }
}

TEST_CASE("a tolerance that rounded weights cannot meet ends the solve soon") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3}) {
    SeedArray seeds = empty_seeds(d);
    add_cluster(seeds, random_place(d, random), 1e-8, 200, random);
    add_cluster(seeds, random_place(d, random), 1e-3, 100, random);
    TransportOptions options = transport_options();
    options.tolerance = 1e-9;
    const TransportResult found = transport(transport_device(), unit_box(d), seeds.view(), {}, options);
    CHECK(!found.converged);
    CHECK(found.error < found.rounding_error);
    CHECK(found.diagrams <= most_diagrams);
  }
}

TEST_CASE("clusters in a periodic box, also across its faces") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3})
    for (const double width : {1e-3, 1e-9}) {
      INFO(d << "D, width " << width);
      const std::vector<double> zero(static_cast<std::size_t>(d)), one(static_cast<std::size_t>(d), 1.0);
      const Domain domain = Domain::periodic_box(zero, one);
      SeedArray seeds = empty_seeds(d);
      add_cluster(seeds, zero, width, 100, random);
      check_solved(domain, seeds);
      add_cluster(seeds, random_place(d, random), 0.01, 100, random);
      add_cluster(seeds, random_place(d, random), 0.4, 100, random);
      check_solved(domain, seeds);
    }
}

TEST_CASE("clusters on surfaces and in polygons and solids with holes") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const TransportCase& c : transport_cases(40, 1)) {
    for (const double width : {1e-3, 1e-6}) {
      // Cells of a narrow cluster lie in both arms, and nothing passes mass from one arm to the other.
      if (c.name == "letter U" && width < 1e-3) continue;
      INFO(c.name << ", width " << width);
      const auto d = static_cast<std::size_t>(c.seeds.dimension);
      SeedArray seeds = empty_seeds(c.seeds.dimension);
      for (const std::size_t k : {3u, 17u, 30u})
        add_cluster(seeds, {&c.seeds.positions[k * d], &c.seeds.positions[k * d] + d}, width, 50, random);
      check_solved(c.domain, seeds);
    }
  }
}

TEST_CASE("a solve that is interrupted while it solves for clusters can be repeated") {
  INFO(replay_hint());
  Random random(test_seed());
  SeedArray seeds = empty_seeds(2);
  for (int k = 0; k < 8; ++k) add_cluster(seeds, random_place(2, random), 1e-4, 30, random);
  const TransportResult expected =
      transport(transport_device(), unit_box(2), seeds.view(), {}, transport_options());
  REQUIRE(expected.converged);
  for (int last = 1; last < 12; ++last) {
    int calls = 0;
    bool enough = false;
    TransportOptions options = transport_options();
    options.progress = [&](const TransportStep&) { return enough || ++calls < last; };
    TransportSolver solver(transport_device(), unit_box(2), options);
    solver.set_seeds(seeds.view());
    bool interrupted = false;
    try {
      solver.solve();
    } catch (const Error& error) {
      interrupted = error.code() == ErrorCode::interrupted;
    }
    CHECK(interrupted == (calls == last));
    enough = true;
    CHECK(distance(solver.solve().weights, expected.weights) < 1e-15);
    CHECK((!interrupted || solver.result().weights == expected.weights));
    CHECK(distance(solver.diagram().measures().mass, expected.mass) < 1e-15);
  }
}

TEST_CASE("fifty mixtures of clusters of random sizes, widths and shapes") {
  INFO(replay_hint());
  Random random(test_seed());
  for (int k = 0; k < 50; ++k) {
    const int d = 2 + k % 2;
    SeedArray seeds = empty_seeds(d);
    const int clusters = 1 + static_cast<int>(7 * random.uniform());
    for (int c = 0; c < clusters; ++c) {
      const std::vector<double> about = random_place(d, random);
      const double width = std::pow(10, -1 - 8 * random.uniform());
      const auto n = static_cast<std::size_t>(std::pow(10, 0.3 + 2 * random.uniform()));
      add_cluster(seeds, about, width, n, random);
      if (k % 3 == 0) add_cluster(seeds, about, std::min(30 * width, 0.1), n, random);  // a halo about it
    }
    if (random.uniform() < 0.5)
      add_cluster(seeds, std::vector<double>(static_cast<std::size_t>(d), 0.5), 1, 100, random);
    INFO("mixture " << k << ": " << seeds.positions.size() / static_cast<std::size_t>(d) << " seeds in " << d
                    << "D");
    check_solved(unit_box(d), seeds);
  }
}
