// Thousands of seeds against diagrams of bounded boxes with copies of all seeds, and against voro++.
#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "tests/periodic/brute_force.hpp"
#include "tests/support/setups.hpp"
#include "tests/support/voro.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The seeds, then copies in all boxes around.
SeedArray with_copies(const SeedArray& seeds, int dimension) {
  SeedArray copies{dimension, seeds.positions, seeds.weights};
  for (int a = -1; a <= 1; ++a)
    for (int b = -1; b <= 1; ++b)
      for (int c = dimension == 3 ? -1 : 0; c <= (dimension == 3 ? 1 : 0); ++c) {
        if (a == 0 && b == 0 && c == 0) continue;
        const double by[3] = {static_cast<double>(a), static_cast<double>(b), static_cast<double>(c)};
        for (std::size_t i = 0; i < seeds.size(); ++i) {
          for (int k = 0; k < dimension; ++k) copies.positions.push_back(seeds.coordinate(i, k) + by[k]);
          copies.weights.push_back(seeds.weights[i]);
        }
      }
  return copies;
}

}  // namespace

TEST_CASE("cells in a periodic box are those among copies") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const int d : {2, 3})
    for (const Distribution distribution : {Distribution::white, Distribution::cluster})
      for (const WeightRange range : {WeightRange::W0, WeightRange::W2}) {
        // White seeds without weights and clusters with hidden seeds, or all four pairs.
        if ((distribution == Distribution::white) == (range == WeightRange::W2) && !all_inputs()) continue;
        const std::size_t n = d == 2 ? 3000 : 1500;
        const SeedArray seeds = random_seeds(distribution, range, n, d, random);
        const SeedArray copies = with_copies(seeds, d);
        const std::array<double, 3> far_low{-1, -1, -1}, far_high{2, 2, 2}, low{0, 0, 0}, high{1, 1, 1};
        const auto corner = [&](const std::array<double, 3>& x) {
          return std::span(x).first(static_cast<std::size_t>(d));
        };
        for (const Setup& setup : main_setups()) {
          INFO(setup.name << ", " << d << "D " << name(distribution) << ' ' << name(range));
          Options options = setup.options;
          options.certify = true;
          Diagram diagram(setup.device, Domain::periodic_box(corner(low), corner(high)), options);
          Diagram among(setup.device, Domain::box(corner(far_low), corner(far_high)), setup.options);
          diagram.set_seeds(seeds.view());
          among.set_seeds(copies.view());
          diagram.compute(true, false);
          among.compute(true, false);
          const bool single = diagram.precision() == Precision::float32;
          const double mass_tolerance = (single ? 1e-3 : 1e-10) / static_cast<double>(n);
          const double wall_tolerance =
              (single ? 1e-3 : 1e-9) * std::pow(static_cast<double>(n), -(d - 1.0) / d);
          const Adjacency &here = diagram.adjacency(), &there = among.adjacency();
          std::size_t different = 0, walls = 0, status = 0;
          for (std::size_t i = 0; i < n; ++i) {
            different += !(std::abs(diagram.measures().mass[i] - among.measures().mass[i]) < mass_tolerance);
            status += diagram.measures().status[i] != among.measures().status[i];
            std::map<std::pair<std::uint32_t, ImageShift>, double> expected;
            for (std::uint64_t k = there.offset[i]; k < there.offset[i + 1]; ++k) {
              const std::uint32_t copy = there.neighbor[k], j = copy % static_cast<std::uint32_t>(n);
              ImageShift shift{};
              for (int c = 0; c < d; ++c)
                shift[static_cast<std::size_t>(c)] = static_cast<std::int32_t>(
                    std::lround(copies.coordinate(copy, c) - seeds.coordinate(j, c)));
              expected[{j, shift}] = there.wall[k];
            }
            for (std::uint64_t k = here.offset[i]; k < here.offset[i + 1]; ++k) {
              const auto found = expected.find({here.neighbor[k], here.shift[k]});
              const double wall = found == expected.end() ? 0 : found->second;
              walls += !(std::abs(here.wall[k] - wall) < wall_tolerance);
              if (found != expected.end()) expected.erase(found);
            }
            for (const auto& [image, wall] : expected) walls += !(wall < wall_tolerance);
          }
          CHECK(here.offset[n] > n);
          CHECK(different == 0);
          CHECK(walls == 0);
          if (!single) CHECK(status == 0);
        }
      }
}

namespace {

void check_volumes(Diagram& diagram, const std::vector<double>& volume) {
  const double mean = diagram.domain().measure() / static_cast<double>(volume.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < volume.size(); ++i)
    different += !(std::abs(diagram.measures().mass[i] - volume[i]) < 1e-9 * mean);
  CHECK(different == 0);
}

}  // namespace

TEST_CASE("periodic boxes of space agree with voro++") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::size_t n = 2000;
  const double edge[3] = {1, 1.5, 0.8};
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, n, 3, random);
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) seeds.coordinate(i, k) *= edge[k];
  const bool periodic[] = {true, false, true};
  const std::vector<double> volume =
      periodic_volumes(seeds.view(), {{0, 0, 0}, {edge[0], edge[1], edge[2]}}, {true, false, true});
  const std::array<double, 3> low{0, 0, 0};
  for (const Setup& setup : main_setups()) {
    Diagram diagram(setup.device, Domain::periodic_box(low, edge, periodic), setup.options);
    if (diagram.precision() == Precision::float32) continue;
    diagram.set_seeds(seeds.view());
    check_volumes(diagram, volume);
  }
}

TEST_CASE("triclinic cells of space agree with voro++") {
  INFO(replay_hint());
  Random random(test_seed());
  const std::size_t n = 1000;
  // voro++'s unit cell: (bx, 0, 0), (bxy, by, 0), (bxz, byz, bz).
  const double bx = 1, bxy = 0.3, by = 1.1, bxz = -0.25, byz = 0.4, bz = 0.9;
  const double vectors[] = {bx, 0, 0, bxy, by, 0, bxz, byz, bz};
  SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, n, 3, random);
  for (std::size_t i = 0; i < n; ++i) {
    const double u = seeds.coordinate(i, 0), v = seeds.coordinate(i, 1), w = seeds.coordinate(i, 2);
    seeds.coordinate(i, 0) = u * bx + v * bxy + w * bxz;
    seeds.coordinate(i, 1) = v * by + w * byz;
    seeds.coordinate(i, 2) = w * bz;
  }
  const std::vector<double> volume = triclinic_volumes(seeds.view(), {bx, bxy, by, bxz, byz, bz});
  for (const Setup& setup : main_setups()) {
    Diagram diagram(setup.device, Domain::lattice(vectors), setup.options);
    if (diagram.precision() == Precision::float32) continue;
    diagram.set_seeds(seeds.view());
    check_volumes(diagram, volume);
  }
}
