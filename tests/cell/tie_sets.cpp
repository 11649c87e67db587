// Seeds that tie exactly in one point: integer points of a circle and of a sphere. Every other seed is
// decided exactly as the oracle.
#include "lib/cell/tie_sets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/clip/random_scene.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// The integer points at a distance of the root of `square` from the origin, times 2^-scale, about the middle
/// of the unit box.
std::vector<double> integer_points(int dimension, int square, int scale) {
  std::vector<double> positions;
  const int most = static_cast<int>(std::sqrt(square));
  const int depth = dimension == 3 ? most : 0;
  for (int x = -most; x <= most; ++x)
    for (int y = -most; y <= most; ++y)
      for (int z = -depth; z <= depth; ++z) {
        if (x * x + y * y + z * z != square) continue;
        positions.push_back(0.5 + std::ldexp(x, -scale));
        positions.push_back(0.5 + std::ldexp(y, -scale));
        if (dimension == 3) positions.push_back(0.5 + std::ldexp(z, -scale));
      }
  return positions;
}

bool are_independent(const HostScene& scene, const std::vector<std::uint32_t>& corners) {
  std::array<std::array<double, 3>, 3> edge{};
  for (std::size_t k = 1; k < corners.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      edge[k - 1][c] = scene.points[corners[k]][c] - scene.points[corners[0]][c];
  if (corners.size() == 3) return edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0] != 0;
  const auto minor = [&](std::size_t a, std::size_t b) {
    return edge[1][a] * edge[2][b] - edge[1][b] * edge[2][a];
  };
  return edge[0][0] * minor(1, 2) + edge[0][1] * minor(2, 0) + edge[0][2] * minor(0, 1) != 0;
}

double distance(const HostScene& scene, std::uint32_t a, std::uint32_t b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c)
    sum += (scene.points[a][c] - scene.points[b][c]) * (scene.points[a][c] - scene.points[b][c]);
  return sum;
}

void check(int dimension, std::vector<double> positions) {
  const auto context = test_context();
  if (!context->info().fp64) return;
  const std::size_t n = positions.size() / static_cast<std::size_t>(dimension);
  const RandomScene s(context, dimension, {std::move(positions), std::vector<double>(n)}, false);
  const HostScene scene = make_host_scene(s.scene);
  TieSets sets(scene);
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  CHECK(sets.find(std::vector<std::uint32_t>{0, 1, 2}) == nullptr);
  sets.learn(all);
  ExactCell exact(scene);
  std::mt19937_64 random(3);
  std::size_t taken = 0, kept = 0;
  for (int round = 0; round < 4000; ++round) {
    std::vector<std::uint32_t> corners(static_cast<std::size_t>(dimension) + 1);
    // The seed of the largest infinitesimal is a corner of all vertices that nobody takes.
    for (std::uint32_t& corner : corners) corner = static_cast<std::uint32_t>(random() % n);
    if (round % 4 > 1) {  // neighbours on the circle or sphere
      std::vector<std::uint32_t> near = all;
      std::partial_sort(near.begin(), near.begin() + 8, near.end(), [&](std::uint32_t a, std::uint32_t b) {
        return distance(scene, corners[0], a) < distance(scene, corners[0], b);
      });
      for (std::size_t k = 1; k < corners.size(); ++k) corners[k] = near[1 + random() % 7];
    }
    if (round % 2 == 0)
      corners[static_cast<std::size_t>(round / 2) % corners.size()] = sets.find(all)->front();
    if (!are_independent(scene, corners)) continue;
    ExactVertex vertex{};
    for (std::size_t k = 1; k < corners.size(); ++k) vertex[k - 1] = static_cast<std::int32_t>(corners[k]);
    exact.start(corners[0], 0);
    const auto takes = [&](std::uint32_t rank) {
      return std::find(corners.begin(), corners.end(), rank) == corners.end() &&
             exact.is_outside(vertex, static_cast<std::int32_t>(rank));
    };
    REQUIRE(sets.find(corners) != nullptr);
    const std::optional<std::uint32_t> taker = sets.taker(*sets.find(corners), corners, vertex, exact);
    REQUIRE(taker.has_value() == std::any_of(all.begin(), all.end(), takes));
    if (taker) REQUIRE(takes(*taker));
    (taker ? taken : kept) += 1;
  }
  CHECK(taken > 1000);
  CHECK(kept > 2);
}

}  // namespace

TEST_CASE("a known set of ties decides as exact decisions with all of its seeds do") {
  check(2, integer_points(2, 1105 * 1105, 12));  // 108
  check(3, integer_points(3, 101, 5));           // 168
  check(3, integer_points(3, 1001, 7));          // 480
}
