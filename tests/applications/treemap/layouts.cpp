// Whole layouts: areas, nesting, dropped nodes, determinism, large groups, updates. Everything is measured
// again from the vertices.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <powercell/shapes.hpp>

#include "tests/applications/treemap/made_trees.hpp"
#include "tests/support/setups.hpp"

using namespace powercell;
using namespace powercell::test;

namespace {

std::vector<std::array<double, 2>> polygon(const Treemap& map, std::size_t i) {
  std::vector<std::array<double, 2>> points;
  for (std::uint64_t v = map.vertex_offset[i]; v < map.vertex_offset[i + 1]; ++v)
    points.push_back({map.vertices[2 * v], map.vertices[2 * v + 1]});
  return points;
}

/// The area in extended precision, by another formula than the library's.
double area(const std::vector<std::array<double, 2>>& p) {
  long double twice = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const auto &a = p[k], &b = p[(k + 1) % p.size()];
    twice += static_cast<long double>(a[0]) * b[1] - static_cast<long double>(a[1]) * b[0];
  }
  return static_cast<double>(twice / 2);
}

/// The mean of the vertices.
std::array<double, 2> middle(const std::vector<std::array<double, 2>>& p) {
  std::array<double, 2> sum{};
  for (const auto& v : p) sum = {sum[0] + v[0], sum[1] + v[1]};
  return {sum[0] / static_cast<double>(p.size()), sum[1] / static_cast<double>(p.size())};
}

/// The largest distance by which a vertex of `inner` is outside `outer`; both counter-clockwise and convex.
double excess(const std::vector<std::array<double, 2>>& inner,
              const std::vector<std::array<double, 2>>& outer) {
  double most = 0;
  for (const auto& p : inner)
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const auto &a = outer[k], &b = outer[(k + 1) % outer.size()];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1]);
      if (length == 0) continue;
      most = std::max(most, ((p[0] - a[0]) * (b[1] - a[1]) - (p[1] - a[1]) * (b[0] - a[0])) / length);
    }
  return most;
}

/// Checks that every node with a value has its share, and that children lie in their parent and fill it.
void check_layout(const MadeTree& tree, const Treemap& map, const Ring& outline, double tolerance = 1e-6) {
  const std::size_t n = tree.parent.size();
  REQUIRE(map.kind.size() == n);
  REQUIRE(map.vertex_offset.size() == n + 1);
  const double whole = std::fabs(area(outline)), size = std::sqrt(whole);
  std::vector<double> filled(n, 0);
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) {
    CAPTURE(i);
    const auto own = polygon(map, i);
    if (map.kind[i] == TreeNode::dropped) {
      CHECK(own.empty());
      continue;
    }
    const double error = std::fabs(area(own) / whole / (map.value[i] / map.value[0]) - 1);
    CHECK(error <= tolerance);
    if (map.kind[i] == TreeNode::leaf) worst = std::max(worst, error);
    if (i == 0) continue;
    const auto above = static_cast<std::size_t>(tree.parent[i]);
    filled[above] += area(own);
    CHECK(excess(own, polygon(map, above)) <= 1e-12 * size);
  }
  for (std::size_t i = 0; i < n; ++i)
    if (map.kind[i] == TreeNode::group)
      CHECK(filled[i] == doctest::Approx(area(polygon(map, i))).epsilon(1e-9));
  CHECK(map.worst_error == doctest::Approx(worst).epsilon(1e-3));
  CHECK(map.not_converged.empty());
}

/// The mean distance of the leaves of `a` from their positions in `b`.
double moved(const Treemap& a, const Treemap& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.kind.size(); ++i) {
    if (a.kind[i] != TreeNode::leaf) continue;
    const auto from = middle(polygon(a, i)), to = middle(polygon(b, i));
    sum += std::hypot(from[0] - to[0], from[1] - to[1]);
  }
  return sum / static_cast<double>(a.leaves);
}

}  // namespace

TEST_CASE("trees of every shape get the right areas") {
  INFO(replay_hint());
  Random random(test_seed());
  const Ring hexagon = disk(6), circle = disk(128), sliver = {{0, 0}, {100, 30}, {100, 31}, {0, 1}};
  for (const Ring& outline : {square, hexagon, circle, sliver, Ring{{0, 0}, {0, 3}, {4, 0}}}) {
    for (const std::size_t breadth : {3u, 30u, 2000u}) {
      const MadeTree tree = random_tree(2000, breadth, 1000, random);
      const Treemap map = treemap(tree.view(), outline);
      check_layout(tree, map, outline);
    }
  }
}

TEST_CASE("a group with values over six orders of magnitude gets the right areas") {
  Random random(test_seed());
  for (const std::size_t n : {2u, 10u, 100u, 700u}) {
    const MadeTree tree = flat_tree(n, 1e6, random);
    check_layout(tree, treemap(tree.view(), square), square);
  }
  MadeTree one_giant;
  for (int k = 0; k < 200; ++k) one_giant.add(0, k == 0 ? 1e8 : 1);
  check_layout(one_giant, treemap(one_giant.view(), square), square);
}

TEST_CASE("cells have a small aspect ratio") {
  Random random(test_seed());
  const MadeTree tree = flat_tree(500, 10, random);
  TreemapOptions coarse;
  coarse.rounds = 0;
  const double rough = treemap(tree.view(), square, coarse).mean_aspect;
  const double round = treemap(tree.view(), square).mean_aspect;
  CHECK(round < 1.25);
  CHECK(rough > round + 0.1);
}

TEST_CASE("an only child gets the polygon of its parent, through any number of levels") {
  MadeTree tree;
  std::size_t at = 0;
  for (int k = 0; k < 5000; ++k) at = tree.add(at, 0);
  tree.add(at, 3);
  const Treemap map = treemap(tree.view(), square);
  CHECK(map.depth.back() == 5001);
  CHECK(polygon(map, map.kind.size() - 1) == polygon(map, 0));
  CHECK(map.leaves == 1);
  CHECK(map.diagrams == 0);
}

TEST_CASE("leaves with values of 0 and below are dropped, and groups of only such leaves") {
  MadeTree tree;
  const std::size_t empty = tree.add(0, 5), full = tree.add(0, 5);  // values of groups are ignored
  const std::size_t zero = tree.add(empty, 0), negative = tree.add(empty, -1e9);
  const std::size_t kept = tree.add(full, 2), other = tree.add(full, -3);
  const Treemap map = treemap(tree.view(), square);
  for (const std::size_t i : {empty, zero, negative, other}) CHECK(map.kind[i] == TreeNode::dropped);
  CHECK(map.kind[kept] == TreeNode::leaf);
  CHECK(map.kind[full] == TreeNode::group);
  CHECK(map.value[0] == 2);
  CHECK(polygon(map, kept) == polygon(map, 0));
  check_layout(tree, map, square);
}

TEST_CASE("nodes thinner than rounding, and their descendants, are reported") {
  // In an outline of 10^9 by 7, shares as thin as rounding errors at 10^9: a leaf, and a group of groups.
  const double far = 1e9;
  const Ring needle = {{far, far}, {2 * far, far}, {2 * far, far + 7}, {far, far + 7}};
  const std::vector<std::int64_t> parent{-1, 0, 0, 0, 3, 3, 4, 4};
  const std::vector<double> value{0, 1, 2e-16, 0, 0, 2e-16, 2e-16, 2e-16};
  std::size_t without_place = 0;
  for (const std::size_t large_group : {std::size_t{4096}, std::size_t{0}})
    for (int seed = 0; seed < 20; ++seed) {
      CAPTURE(large_group);
      CAPTURE(seed);
      TreemapOptions options;
      options.large_group = large_group;
      options.random_seed = static_cast<std::uint64_t>(seed);
      const Treemap map = treemap({parent, value}, needle, options);
      CHECK(map.leaves == 5);
      CHECK(std::isfinite(map.mean_aspect));
      for (std::size_t node = 1; node < parent.size(); ++node) {
        if (!polygon(map, node).empty()) continue;
        ++without_place;
        CHECK(map.worst_error >= 1);
        const auto group = static_cast<std::size_t>(parent[node]);
        CHECK(std::ranges::find(map.not_converged, group) != map.not_converged.end());
        if (polygon(map, group).empty()) CHECK(std::isnan(map.seeds[2 * node]));
      }
    }
  CHECK(without_place > 0);
}

TEST_CASE("threads do not change the bits; another random seed gives another layout") {
  Random random(test_seed());
  const MadeTree tree = random_tree(3000, 200, 100, random);
  TreemapOptions one, four, other;
  one.threads = 1;
  four.threads = 4;
  other.random_seed = 7;
  const Treemap a = treemap(tree.view(), square, one), b = treemap(tree.view(), square, four);
  CHECK(a.vertices == b.vertices);
  CHECK(a.vertices != treemap(tree.view(), square, other).vertices);
}

TEST_CASE("large groups are laid out on the device, with the right areas") {
  Random random(test_seed());
  const MadeTree tree = flat_tree(1500, 1000, random);
  TreemapOptions options;
  options.large_group = 1000;
  options.rounds = 6;
  options.device = main_setups().front().device;
  const Treemap map = treemap(tree.view(), disk(40), options);
  check_layout(tree, map, disk(40));
  options.large_group = 5000;
  CHECK(map.mean_aspect ==
        doctest::Approx(treemap(tree.view(), disk(40), options).mean_aspect).epsilon(0.05));
}

TEST_CASE("an update stays close to the earlier layout") {
  Random random(test_seed());
  MadeTree tree = random_tree(400, 60, 10, random);
  const Treemap first = treemap(tree.view(), square);
  const std::vector<double> start =
      relative_positions(tree.parent, first.seeds, first.vertex_offset, first.vertices);
  TreemapOptions unchanged;
  unchanged.start = start;
  CHECK(moved(first, treemap(tree.view(), square, unchanged)) < 1e-3);
  for (double& v : tree.value) v *= random.uniform(0.9, 1.1);
  tree.add(0, 1);  // a new leaf of the root, without an earlier position
  std::vector<double> longer = start;
  longer.resize(2 * tree.parent.size(), std::nan(""));
  TreemapOptions stable;
  stable.start = longer;
  const Treemap updated = treemap(tree.view(), square, stable), fresh = treemap(tree.view(), square);
  check_layout(tree, updated, square);
  CHECK(moved(first, updated) < 0.1 * moved(first, fresh));
}

TEST_CASE("an update of an unchanged tree with values over many orders of magnitude keeps its seeds") {
  for (const double orders : {6, 10, 14})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      CAPTURE(orders);
      CAPTURE(seed);
      std::vector<std::int64_t> parent{TreeView::no_parent};
      std::vector<double> value{0};
      Random random(seed);
      for (int k = 0; k < 40; ++k) {
        parent.push_back(0);
        value.push_back(std::pow(10, random.uniform(0, orders)));
      }
      const Treemap first = treemap({parent, value}, square);
      const std::vector<double> start =
          relative_positions(parent, first.seeds, first.vertex_offset, first.vertices);
      TreemapOptions again;
      again.start = start;
      const Treemap same = treemap({parent, value}, square, again);
      double most = 0;  // displacement of a seed; polygons agree to the tolerance only
      for (std::size_t k = 0; k < first.seeds.size(); ++k)
        most = std::max(most, std::fabs(first.seeds[k] - same.seeds[k]));
      CHECK(most < 1e-12);
    }
}

TEST_CASE("an update from a layout with all seeds at one position") {
  MadeTree tree;
  for (int child = 0; child < 9; ++child) tree.add(0, 1 + child % 3);
  const std::vector<double> start(2 * tree.parent.size(), 0.1);
  TreemapOptions options;
  options.start = start;
  check_layout(tree, treemap(tree.view(), square, options), square);
}

TEST_CASE("progress is reported and can interrupt") {
  Random random(test_seed());
  const MadeTree tree = random_tree(300, 20, 10, random);
  TreemapOptions options;
  double last = 0;
  options.progress = [&](double fraction) {
    CHECK(fraction >= last);
    last = fraction;
    return true;
  };
  (void)treemap(tree.view(), square, options);
  CHECK(last > 0.9);
  CHECK(last <= 1);
  options.progress = [](double) { return false; };
  CHECK_THROWS_WITH_AS(treemap(tree.view(), square, options), "treemap: interrupted", Error);
}
