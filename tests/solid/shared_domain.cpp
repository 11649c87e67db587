// Diagrams that share what their domain keeps.
#include <doctest/doctest.h>

#include <thread>

#include "tests/solid/both_ways.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

TEST_CASE("solid: diagrams in several threads on one domain have the same bits") {
  if (!has_double()) return;
  Random random(test_seed());
  const Mesh mesh = solid_meshes(random)[3].mesh;
  const Mesh surface = boundary_mesh(volume_of(mesh));
  for (const bool solid : {true, false}) {
    const auto make = [&] {
      return solid ? Domain::solid(surface.vertices, surface.elements) : volume_of(mesh);
    };
    const SeedArray seeds = seeds_for(make(), Distribution::white, WeightRange::W1, 300, random);
    const auto masses = [&](const Domain& domain) {
      Diagram diagram(double_device_of_tests(), domain);
      diagram.set_seeds(seeds.view());
      return diagram.measures().mass;
    };
    const std::vector<double> alone = masses(make());
    const Domain shared = make();
    std::vector<std::vector<double>> results(4);
    std::vector<std::thread> threads;
    for (std::vector<double>& result : results) threads.emplace_back([&] { result = masses(shared); });
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<double>& result : results) CHECK(result == alone);
    CHECK(masses(shared) == alone);
  }
}
