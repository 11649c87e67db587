// Pieces of a polygon have collinear corners where other pieces have corners. Bisectors lie on such a line, a
// few units in the last place beside it, or are rotated by as little.
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

/// A bar with teeth of width 1 above and below, on the lines y = 0 and y = 1.
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

/// A few units in the last place of numbers about 1, often 0.
double little(Random& random) {
  return 0x1p-53 * static_cast<double>(random.index(9)) - 0x1p-51 + (random.index(3) == 0 ? 0x1p-51 : 0.0);
}

/// Lines with teeth, and the distance by which the bisector is moved down.
std::vector<std::pair<double, double>> cases() {
  std::vector<std::pair<double, double>> list;
  for (const double line : {0.0, 1.0})
    for (const double moved : {0.0, 0x1p-56, -0x1p-56, 0x1p-53, -0x1p-53}) list.emplace_back(line, moved);
  return list;
}

}  // namespace

TEST_CASE("a bisector on a line of many corners: exact masses, walls of the teeth or of the bar") {
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    const double tolerance = 16 * unit_roundoff(setup.options.precision);
    for (const bool upright : {true, false})
      for (const auto& place : cases())
        for (const bool swapped : {false, true}) {
          const double line = place.first, moved = place.second;
          CAPTURE(upright);
          CAPTURE(line);
          CAPTURE(moved);
          CAPTURE(swapped);
          // The bisector of seeds 1/4 below and above the line with weights 0 and w is exactly at -w from it.
          SeedArray seeds{2, {}, {0, 0}};
          for (const double y : {line - 0.25, line + 0.25})
            seeds.positions.insert(seeds.positions.end(), {3.0, y});
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
          const double below = line == 1 ? all - teeth : teeth;
          CHECK(std::abs(mass[low] - below) < tolerance * all);
          CHECK(std::abs(mass[1 - low] - (all - below)) < tolerance * all);
          const Adjacency& walls = diagram.adjacency();
          REQUIRE(walls.neighbor == std::vector<std::uint32_t>{1, 0});
          // On the line the wall ends with the teeth; within the bar it crosses all of it.
          const double expected = line == 1 ? (moved > 0 ? bar : teeth) : (moved < 0 ? bar : teeth);
          CHECK(walls.wall[0] == doctest::Approx(expected).epsilon(tolerance));
          CHECK(walls.wall[1] == doctest::Approx(expected).epsilon(tolerance));
        }
  }
}

TEST_CASE("a grid whose cells end with the teeth") {
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    const double tolerance = 16 * unit_roundoff(setup.options.precision);
    for (const bool upright : {true, false})
      for (const double line : {0.0, 1.0}) {
        CAPTURE(upright);
        CAPTURE(line);
        SeedArray seeds{2, {}, {}};
        const auto columns = static_cast<std::size_t>(bar);
        for (const double y : {line - 0.25, line + 0.25})
          for (std::size_t k = 0; k < columns; ++k) {
            const double x = static_cast<double>(k) + 0.5;
            seeds.positions.insert(seeds.positions.end(), {upright ? x : y, upright ? y : x});
            seeds.weights.push_back(0);
          }
        Diagram diagram(setup.device, comb(upright), setup.options);
        diagram.set_seeds(seeds.view());
        const Measures& measures = diagram.measures();
        const Adjacency& walls = diagram.adjacency();
        for (std::size_t k = 0; k < columns; ++k) {
          CAPTURE(k);
          const bool tooth = k % 2 == 1;
          const std::size_t out = line == 1 ? k + columns : k, in = line == 1 ? k : k + columns;
          CHECK(std::abs(measures.mass[out] - (tooth ? 1 : 0)) < tolerance);
          CHECK(measures.status[out] == (tooth ? SeedStatus::ok : SeedStatus::hidden));
          CHECK(std::abs(measures.mass[in] - (tooth ? 2 : 1)) < 4 * tolerance);
          const std::uint64_t begin = walls.offset[out], end = walls.offset[out + 1];
          REQUIRE(end - begin == (tooth ? 1 : 0));
          if (!tooth) continue;
          CHECK(walls.neighbor[begin] == in);
          CHECK(walls.wall[begin] == doctest::Approx(1).epsilon(tolerance));
        }
      }
  }
}

TEST_CASE("bisectors rotated and moved by units in the last place about such lines") {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Setup& setup : all_setups()) {
    INFO(setup.name);
    const double tolerance = 16 * unit_roundoff(setup.options.precision);
    for (const bool upright : {true, false}) {
      Diagram diagram(setup.device, comb(upright), setup.options);
      for (int trial = 0; trial < 40; ++trial) {
        CAPTURE(trial);
        // Pairs that are mirror images in y = 0 and y = 1, up to units in the last place.
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
