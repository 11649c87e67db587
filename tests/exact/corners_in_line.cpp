// Pieces of a polygon have corners in line where other pieces have theirs: bisectors along such a line, a few
// last places beside it, and turned by as little.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/diagram.hpp>
#include <utility>
#include <vector>

#include "tests/support/domains.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr int teeth = 5;

/// A bar with teeth above and below, all of them 1 wide; the lines where they stand are y = 0 and y = 1.
Domain comb(bool upright) {
  std::vector<std::array<double, 2>> ring{{0, 0}};
  const auto add = [&](double x, double y) { ring.push_back({x, y}); };
  for (int k = 0; k < teeth; ++k)
    for (const auto& [x, y] : {std::pair{1, 0}, {1, -1}, {2, -1}, {2, 0}}) add(2 * k + x, y);
  add(2 * teeth + 1, 0);
  add(2 * teeth + 1, 1);
  for (int k = teeth; k-- > 0;)
    for (const auto& [x, y] : {std::pair{2, 1}, {2, 2}, {1, 2}, {1, 1}}) add(2 * k + x, y);
  add(0, 1);
  if (!upright)
    for (auto& [x, y] : ring) std::swap(x, y);
  PolygonPart part;
  part.outer.assign(ring.begin(), ring.end());
  if (!upright) std::reverse(part.outer.begin(), part.outer.end());
  return Domain::polygon({&part, 1});
}

constexpr double bar = 2 * teeth + 1, all = bar + 2 * teeth;

/// Last places of numbers about 1, some of them none.
double little(Random& random) {
  return 0x1p-53 * static_cast<double>(random.index(9)) - 0x1p-51 + (random.index(3) == 0 ? 0x1p-51 : 0.0);
}

}  // namespace

TEST_CASE("a bisector in the line of many corners: exact masses, walls of the teeth or of the bar") {
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    const double tolerance = 16 * unit_roundoff(setup.options.precision);
    for (const bool upright : {true, false})
      for (const double moved : {0.0, 0x1p-56, -0x1p-56, 0x1p-53, -0x1p-53})
        for (const bool swapped : {false, true}) {
          CAPTURE(upright);
          CAPTURE(moved);
          CAPTURE(swapped);
          // The bisector of y = 3/4 and y = 5/4 with weights 0 and w is y = 1 - w: to the bit.
          SeedArray seeds{2, {}, {0, 0}};
          for (const double y : {0.75, 1.25}) seeds.positions.insert(seeds.positions.end(), {3.0, y});
          if (!upright)
            for (std::size_t k = 0; k < 4; k += 2) std::swap(seeds.positions[k], seeds.positions[k + 1]);
          seeds.weights[1] = moved;
          if (swapped) {
            for (std::size_t k = 0; k < 2; ++k) std::swap(seeds.positions[k], seeds.positions[2 + k]);
            std::swap(seeds.weights[0], seeds.weights[1]);
          }
          Diagram diagram(setup.device, comb(upright), setup.options);
          diagram.set_seeds(seeds.view());
          const std::size_t low = swapped ? 1 : 0;
          const std::vector<double>& mass = diagram.measures().mass;
          CHECK(std::abs(mass[low] - (all - teeth)) < tolerance * all);
          CHECK(std::abs(mass[1 - low] - teeth) < tolerance * all);
          const Adjacency& walls = diagram.adjacency();
          REQUIRE(walls.neighbor == std::vector<std::uint32_t>{1, 0});
          // Below the line the wall goes through the bar, in it and above through the teeth.
          const double expected = moved > 0 ? bar : teeth;
          CHECK(walls.wall[0] == doctest::Approx(expected).epsilon(tolerance));
          CHECK(walls.wall[1] == doctest::Approx(expected).epsilon(tolerance));
        }
  }
}

TEST_CASE("bisectors turned and moved by last places about such lines") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    const double tolerance = 16 * unit_roundoff(setup.options.precision);
    for (const bool upright : {true, false}) {
      Diagram diagram(setup.device, comb(upright), setup.options);
      for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(trial);
        // Pairs that mirror each other, but for last places, at y = 0 and y = 1.
        SeedArray seeds{2, {}, {}};
        const double x = random.uniform(0, bar), away = random.uniform(0.1, 0.4);
        for (const double y : {-away, away, 1 - away, 1 + away}) {
          seeds.positions.push_back((upright ? x : y) + little(random));
          seeds.positions.push_back((upright ? y : x) + little(random));
          seeds.weights.push_back(little(random));
        }
        diagram.set_seeds(seeds.view());
        const std::vector<double>& mass = diagram.measures().mass;
        const double expected[] = {teeth, bar / 2, bar / 2, teeth};
        for (std::size_t i = 0; i < 4; ++i) CHECK(std::abs(mass[i] - expected[i]) < 1000 * tolerance);
        const Adjacency& walls = diagram.adjacency();
        for (std::size_t i = 0; i < 4; ++i)
          for (std::uint64_t k = walls.offset[i]; k < walls.offset[i + 1]; ++k) {
            const std::size_t j = walls.neighbor[k];
            const auto begin = walls.neighbor.begin();
            const auto back = std::find(begin + static_cast<std::ptrdiff_t>(walls.offset[j]),
                                        begin + static_cast<std::ptrdiff_t>(walls.offset[j + 1]), i);
            REQUIRE(back != begin + static_cast<std::ptrdiff_t>(walls.offset[j + 1]));
            CHECK(walls.wall[static_cast<std::size_t>(back - begin)] ==
                  doctest::Approx(walls.wall[k]).epsilon(tolerance));
          }
      }
    }
  }
}
