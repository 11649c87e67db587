// Brute force, CGAL and voro++ share nothing but the definition of a power diagram.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/brute_force.hpp"
#include "tests/support/cgal.hpp"
#include "tests/support/voro.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

constexpr Distribution distributions[] = {Distribution::white, Distribution::blue, Distribution::cluster};
constexpr WeightRange ranges[] = {WeightRange::W0, WeightRange::W1, WeightRange::W2};

/// Runs `body(seeds)` for every distribution and weight range.
template <class Body>
void for_random_seeds(std::size_t n, int dimension, Body body) {
  INFO(replay_hint());
  Random random(test_seed());
  for (const Distribution distribution : distributions)
    for (const WeightRange range : ranges) {
      INFO(dimension << "D " << name(distribution) << ' ' << name(range));
      body(random_seeds(distribution, range, n, dimension, random));
    }
}

}  // namespace

TEST_CASE("brute force agrees with CGAL's regular triangulation") {
  for (const int d : {2, 3})
    for_random_seeds(150, d, [&](const SeedArray& seeds) {
      const RegularTriangulation cgal = regular_triangulation(seeds.view());
      const ReferenceDiagram all = brute_force(box_mesh(d), seeds.view());
      const ReferenceDiagram few =
          cut_by_candidates(box_mesh(d), seeds.view(), cgal.offset, cgal.neighbor, cgal.hidden);
      CHECK(std::abs(static_cast<double>(few.total() - 1)) < 1e-16);
      for (std::size_t i = 0; i < seeds.size(); ++i) {
        if (cgal.hidden[i]) CHECK(all.status[i] == SeedStatus::hidden);
        CHECK(few.status[i] == all.status[i]);
        CHECK(std::abs(static_cast<double>(few.mass[i] - all.mass[i])) < 1e-17);
      }
      CHECK(few.wall.size() == all.wall.size());
      for (const auto& [pair, measure] : all.wall) {
        REQUIRE(few.wall.count(pair));
        CHECK(std::abs(static_cast<double>(few.wall.at(pair) - measure)) < 1e-14);
      }
    });
}

TEST_CASE("brute force finds the simplices of CGAL whose corners lie in the box") {
  for (const int d : {2, 3})
    for_random_seeds(60, d, [&](const SeedArray& seeds) {
      const RegularTriangulation cgal = regular_triangulation(seeds.view());
      // In a box that contains every corner the two sets are equal.
      const Box wide{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
      const ReferenceDiagram all = brute_force(box_mesh(d, wide), seeds.view());
      std::set<std::array<std::uint32_t, 4>> expected;
      const auto corners = static_cast<std::size_t>(d + 1);
      for (std::size_t s = 0; s < cgal.simplices.size(); s += corners) {
        std::array<std::uint32_t, 4> key{};
        std::copy_n(&cgal.simplices[s], corners, key.begin());
        std::sort(key.begin(), key.begin() + corners);
        key[3] = key[corners - 1];
        expected.insert(key);
      }
      CHECK(all.simplices == expected);
    });
}

TEST_CASE("brute force agrees with voro++'s radical cells") {
  for_random_seeds(200, 3, [&](const SeedArray& seeds) {
    const RadicalCells voro = radical_cells(seeds.view(), {});
    const ReferenceDiagram all = brute_force(box_mesh(3), seeds.view());
    const double mean = 1.0 / static_cast<double>(seeds.size());
    for (std::size_t i = 0; i < seeds.size(); ++i) {
      CHECK(std::abs(voro.volume[i] - static_cast<double>(all.mass[i])) < 1e-9 * mean);
      for (std::uint64_t k = voro.offset[i]; k < voro.offset[i + 1]; ++k) {
        const auto found = all.wall.find({static_cast<std::uint32_t>(i), voro.neighbor[k]});
        const double area = found == all.wall.end() ? 0 : static_cast<double>(found->second);
        CHECK(std::abs(voro.wall[k] - area) < 1e-9);
      }
    }
  });
}
