#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "kernels/layout.h"
#include "lib/scene/scene.hpp"
#include "lib/scene/variant.hpp"
#include "lib/seeds/device_seeds.hpp"
#include "lib/seeds/device_tree.hpp"
#include "lib/seeds/hilbert.hpp"
#include "tests/device_diagram/caller.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/generators.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

/// Seeds ordered on the device in double, in the caller's coordinates.
struct Ordered {
  std::vector<std::uint32_t> order, state;
  std::vector<std::array<double, 4>> points;
};

struct Fixture {
  explicit Fixture(int dimension)
      : defines(Variant{dimension, dimension, false, {1, 1}}.defines()),
        frame(caller.device().context()),
        seeds(caller.device().context(), defines, false, nullptr, {}),
        tree(caller.device().context(), defines) {
    std::array<double, FRAME_SIZE> numbers{};
    numbers[FRAME_SCALE] = numbers[FRAME_UNIT] = 1;
    frame.reserve(sizeof numbers);
    frame.write(numbers.data(), sizeof numbers);
  }
  Ordered order(const SeedArray& s) {
    const auto n = static_cast<std::uint32_t>(s.size());
    const Memory positions(caller, s.positions.size() * 8, s.positions.data());
    const Memory weights(caller, s.weights.size() * 8, s.weights.data());
    seeds.enqueue(frame.handle(), positions.handle(), weights.handle(), n);
    Ordered result{seeds.order.download(), seeds.state.download(), std::vector<std::array<double, 4>>(n)};
    seeds.points.read(result.points.data(), n * sizeof(result.points[0]));
    return result;
  }
  Caller& caller = shared_caller();
  std::vector<std::string> defines;
  cl::RawBuffer frame;
  DeviceSeeds seeds;
  DeviceTree tree;
};

template <int D>
std::vector<std::uint64_t> curve_keys(const Ordered& ordered) {
  double side = 0;
  std::array<double, D> low{};
  for (std::size_t k = 0; k < D; ++k) {
    const auto less = [k](const auto& a, const auto& b) { return a[k] < b[k]; };
    const auto [least, most] = std::minmax_element(ordered.points.begin(), ordered.points.end(), less);
    low[k] = (*least)[k];
    side = std::max(side, (*most)[k] - low[k]);
  }
  int exponent = 0;
  std::frexp(side, &exponent);
  std::vector<std::uint64_t> keys;
  for (const auto& p : ordered.points) {
    std::array<std::uint32_t, D> cell;
    for (std::size_t k = 0; k < D; ++k)
      cell[k] = static_cast<std::uint32_t>(std::ldexp(p[k] - low[k], hilbert_bits<D> - exponent));
    keys.push_back(hilbert_key<D>(cell));
  }
  return keys;
}

}  // namespace

TEST_CASE("seeds follow the Hilbert curve of the host, and none is lost") {
  for (const int dimension : {2, 3}) {
    Fixture fixture(dimension);
    if (!fixture.caller.fp64()) return;
    Random random(test_seed());
    const SeedArray seeds = random_seeds(Distribution::cluster, WeightRange::W1, 5000, dimension, random);
    const Ordered ordered = fixture.order(seeds);
    const auto keys = dimension == 2 ? curve_keys<2>(ordered) : curve_keys<3>(ordered);
    CHECK(std::is_sorted(keys.begin(), keys.end()));
    std::size_t wrong = 0;
    for (std::size_t rank = 0; rank < seeds.size(); ++rank) {
      const std::uint32_t i = ordered.order[rank];
      for (int k = 0; k < dimension; ++k)
        wrong += ordered.points[rank][static_cast<std::size_t>(k)] != seeds.coordinate(i, k);
      wrong += ordered.points[rank][3] != seeds.weights[i] || ordered.state[rank] != SEED_OK;
    }
    CHECK(wrong == 0);
    std::vector<std::uint32_t> sorted = ordered.order, all(seeds.size());
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0u);
    CHECK(sorted == all);
  }
}

TEST_CASE("a cluster far below the grid's resolution is ordered too") {
  Fixture fixture(2);
  if (!fixture.caller.fp64()) return;
  SeedArray seeds{2, {}, {}};
  Random random(test_seed());
  for (int i = 0; i < 4096; ++i) seeds.push({1e-10 * random.uniform(), 1e-10 * random.uniform()}, 0);
  seeds.push({1, 1}, 0);
  const Ordered ordered = fixture.order(seeds);
  double length = 0;
  for (std::size_t rank = 1; rank < 4096; ++rank)
    length += std::hypot(ordered.points[rank][0] - ordered.points[rank - 1][0],
                         ordered.points[rank][1] - ordered.points[rank - 1][1]);
  // A curve through 64 x 64 points of a square is about 64 sides long; a random path would be 2000.
  CHECK(length < 150 * 1e-10);
}

TEST_CASE("tree nodes are the bounding boxes of their seeds") {
  Fixture fixture(3);
  if (!fixture.caller.fp64()) return;
  Random random(test_seed());
  for (const std::size_t n : {1u, 8u, 9u, 64u, 65u, 3000u}) {
    SeedArray seeds = random_seeds(Distribution::white, WeightRange::W1, n, 3, random);
    if (n > 8) std::copy_n(seeds.positions.begin(), 3, seeds.positions.begin() + 3);  // a duplicate
    const Ordered ordered = fixture.order(seeds);
    fixture.tree.enqueue(fixture.seeds.points.handle(), fixture.seeds.points.handle(),
                         static_cast<std::uint32_t>(n));
    const std::vector<std::uint32_t> offset = fixture.tree.level_offset.download();
    REQUIRE(offset.size() == static_cast<std::size_t>(fixture.tree.levels()) + 1);
    REQUIRE(offset.back() == fixture.tree.node_count());
    std::vector<std::array<double, 4>> low(offset.back()), high(offset.back());
    fixture.tree.node_low.read(low.data(), low.size() * sizeof(low[0]));
    fixture.tree.node_high.read(high.data(), high.size() * sizeof(high[0]));
    std::size_t wrong = 0, width = 8;
    for (std::size_t level = 0; level + 1 < offset.size(); ++level, width *= 8)
      for (std::size_t node = 0; node < offset[level + 1] - offset[level]; ++node) {
        std::array<double, 4> a{1e9, 1e9, 1e9, -1e9}, b{-1e9, -1e9, -1e9, 0};
        for (std::size_t rank = node * width; rank < std::min(n, (node + 1) * width); ++rank) {
          if (ordered.state[rank] != SEED_OK) continue;
          for (std::size_t k = 0; k < 3; ++k) {
            a[k] = std::min(a[k], ordered.points[rank][k]);
            b[k] = std::max(b[k], ordered.points[rank][k]);
          }
          a[3] = std::max(a[3], ordered.points[rank][3]);
        }
        wrong += low[offset[level] + node] != a || high[offset[level] + node] != b;
      }
    CHECK(wrong == 0);
  }
}
