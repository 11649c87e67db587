// One to ten seeds in periodic boxes and lattices against their definition.
#include <doctest/doctest.h>

#include <cmath>

#include "tests/periodic/brute_force.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Weights up to this many squared mean spacings.
constexpr double weight_ranges[] = {0, 0.5, 4, 400};

/// \param part  of the space, about a place at random, in which the seeds are
void check_all(const PeriodicSpace& space, std::size_t n, Random& random, double part = 1) {
  for (const double range : weight_ranges) {
    SeedArray seeds = periodic_seeds(space, n, random);
    const SeedArray place = periodic_seeds(space, 1, random);
    for (std::size_t k = 0; k < seeds.positions.size() && part < 1; ++k) {
      const double middle = place.positions[k % static_cast<std::size_t>(seeds.dimension)];
      seeds.positions[k] = middle + part * (seeds.positions[k] - middle);
    }
    const double h =
        std::pow(static_cast<double>(space.measure()) / static_cast<double>(n), 1.0 / space.dimension);
    for (double& w : seeds.weights) w = random.uniform() * range * h * h;
    const std::vector<PeriodicCell> expected = periodic_cells(space, seeds);
    std::vector<Setup> setups = main_setups();
    setups.push_back(setups.front());
    setups.back().options.precision = Precision::float32;
    for (const Setup& setup : setups) {
      INFO(setup.name << ", " << n << " seeds, weights to " << range << " h^2");
      Diagram diagram(setup.device, space.domain(), setup.options);
      diagram.set_seeds(seeds.view());
      const bool single = diagram.precision() == Precision::float32;
      check_periodic(diagram, space, seeds, expected, single ? 1e-5 : 1e-11);
    }
  }
}

}  // namespace

TEST_CASE("periodic boxes of the plane") {
  INFO(replay_hint());
  Random random(test_seed());
  const Box box{{-1, 2, 0}, {2, 4, 0}};
  for (const std::array<bool, 3> axes :
       {std::array{true, true, false}, {true, false, false}, {false, true, false}})
    for (const std::size_t n : {1u, 2u, 3u, 5u, 10u})
      check_all(periodic_box_space(2, box, axes, 3), n, random);
}

TEST_CASE("periodic boxes of space") {
  INFO(replay_hint());
  Random random(test_seed());
  const Box box{{0, 0, -1}, {1, 2, 0.5}};
  for (const std::array<bool, 3> axes :
       {std::array{true, true, true}, {true, false, true}, {false, false, true}})
    for (const std::size_t n : {1u, 2u, 4u, 10u}) check_all(periodic_box_space(3, box, axes, 2), n, random);
}

TEST_CASE("flat periodic boxes") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const std::size_t n : {1u, 3u, 8u}) {
    if (n != 3 && !all_inputs()) continue;
    PeriodicSpace plane = periodic_box_space(2, {{0, 0, 0}, {1, 1e-2, 0}}, {true, true, false}, 2);
    plane.most[1] = 220;  // beyond the length of the box
    check_all(plane, n, random);
    PeriodicSpace space = periodic_box_space(3, {{0, 0, 0}, {1, 0.7, 0.05}}, {true, true, true}, 2);
    space.most[2] = 45;
    check_all(space, n, random);
  }
}

TEST_CASE("lattices of the plane, reduced and not") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const std::size_t n : {1u, 2u, 5u, 10u}) {
    check_all(lattice_space({{{1, 0, 0}, {0.5, 0.8, 0}, {}}}, 2, 3), n, random);
    check_all(lattice_space({{{1, 0.1, 0}, {3.3, 1.2, 0}, {}}}, 2, 8), n, random);
    check_all(lattice_space({{{0.2, 1, 0}, {1, 0.1, 0}, {}}}, 2, 3), n, random);  // left-handed
  }
}

TEST_CASE("lattices of space, reduced and not") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const std::size_t n : {1u, 2u, 6u}) {
    check_all(lattice_space({{{1, 0, 0}, {0.3, 1.1, 0}, {-0.2, 0.4, 0.9}}}, 3, 3), n, random);
    check_all(lattice_space({{{0, 1, 1}, {1, 0, 1}, {1, 1, 0}}}, 3, 3), n, random);  // face-centred
    check_all(lattice_space({{{1, 0, 0}, {2.2, 1, 0}, {0.4, 1.7, 1}}}, 3, 5), n, random);
  }
}

TEST_CASE("droplets in empty periodic space") {
  INFO(replay_hint());
  Random random(test_seed());
  const Box box{{-1, 2, 0}, {2, 4, 2}};
  constexpr double part = 0.1;
  check_all(periodic_box_space(2, box, {true, true, false}, 3), 40, random, part);
  check_all(periodic_box_space(3, box, {true, true, true}, 2), 20, random, part);
  check_all(periodic_box_space(3, box, {true, false, true}, 2), 20, random, part);
  check_all(lattice_space({{{1, 0, 0}, {0.4, 1.2, 0}, {-0.3, 0.2, 0.9}}}, 3, 2), 20, random, part);
}
