// Treemaps of any tree, values and outline: areas are the values, as updates of themselves too.
#include <algorithm>
#include <cmath>
#include <powercell/shapes.hpp>
#include <powercell/treemap.hpp>
#include <string>
#include <vector>

#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"

namespace powercell::fuzz {
namespace {

struct TreeInput {
  std::vector<std::int64_t> parent;
  std::vector<double> value;
  TreeView view() const { return {parent, value}; }
};

/// Mostly a tree whose parents come first.
TreeInput any_tree(Input& input) {
  TreeInput tree;
  const std::size_t n = input.below(40);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t what = input.byte();
    const auto any = static_cast<std::int64_t>(what);
    tree.parent.push_back(i == 0 ? -1 : what < 250 ? any % static_cast<std::int64_t>(i) : any - 252);
  }
  tree.value = input.numbers(input.below(64) == 63 ? n + 1 : n);
  if (input.below(4) != 3)
    for (double& value : tree.value) value = std::fabs(value);
  return tree;
}

Ring any_outline(Input& input) {
  switch (input.below(4)) {
    case 0:
      return {{0, 0}, {3, 0}, {3, 2}, {0, 2}};
    case 1:
      return disk(3 + static_cast<int>(input.below(20)));
    case 2: {
      const double x = input.number(), y = input.number(), width = input.number(), height = input.number();
      return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    }
    default:
      Ring ring(input.below(8));
      for (auto& point : ring)
        for (double& x : point) x = input.number();
      return ring;
  }
}

long double area(const double* points, std::size_t count) {
  long double twice = 0;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const auto edge = [&](std::size_t corner, int axis) {
      return static_cast<long double>(points[2 * corner + static_cast<std::size_t>(axis)]) - points[axis];
    };
    twice += edge(k, 0) * edge(k + 1, 1) - edge(k, 1) * edge(k + 1, 0);
  }
  return twice / 2;
}

/// By how much of its area a polygon may change as its corners are rounded.
long double rounding(const double* points, std::size_t count) {
  long double length = 0, far = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double *const a = points + 2 * k, *const b = points + 2 * ((k + 1) % count);
    length += std::hypot(static_cast<long double>(b[0]) - a[0], static_cast<long double>(b[1]) - a[1]);
    far = std::max<long double>({far, std::fabs(a[0]), std::fabs(a[1])});
  }
  return 4 * 0x1p-53L * far * length / std::fabs(area(points, count));
}

void check(const Treemap& map, const TreeInput& tree, double tolerance) {
  const std::size_t n = tree.parent.size();
  require(map.kind.size() == n && map.value.size() == n && map.depth.size() == n &&
              map.seeds.size() == 2 * n && map.vertex_offset.size() == n + 1 &&
              map.vertices.size() == 2 * map.vertex_offset.back(),
          "arrays of another size than the tree");
  long double leaves = 0, outline = 0;
  std::size_t root = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t begin = map.vertex_offset[i], count = map.vertex_offset[i + 1] - begin;
    require((count == 0) == (map.kind[i] == TreeNode::dropped), "dropped nodes and polygons do not agree");
    if (count == 0) continue;
    require(count >= 3, "a polygon of less than three corners");
    require(map.value[i] > 0 && std::isfinite(map.value[i]), "a node with a polygon and without a value");
    for (std::size_t k = 2 * begin; k < 2 * (begin + count); ++k)
      require(std::isfinite(map.vertices[k]), "a corner that is not finite");
    const long double own = area(&map.vertices[2 * begin], count);
    if (map.kind[i] == TreeNode::leaf) leaves += own;
    if (tree.parent[i] < 0) {
      outline = own;
      root = i;
    }
  }
  require(outline > 0, "an outline without area");
  require(std::fabs(leaves / outline - 1) < 1e-6L, "the leaves do not fill the outline");
  for (std::size_t i = 0; i < n; ++i) {
    if (map.kind[i] != TreeNode::leaf) continue;
    const double* const points = &map.vertices[2 * map.vertex_offset[i]];
    const std::size_t count = map.vertex_offset[i + 1] - map.vertex_offset[i];
    const long double share = static_cast<long double>(map.value[i]) / map.value[root];
    const long double error = std::fabs(area(points, count) / outline / share - 1);
    const long double doubt =
        rounding(points, count) + rounding(&map.vertices[2 * map.vertex_offset[root]],
                                           map.vertex_offset[root + 1] - map.vertex_offset[root]);
    require(error <= map.worst_error * (1 + 1e-12) + doubt, "an area further off than the worst");
    require(error <= tolerance + doubt || !map.not_converged.empty(), "areas beyond the tolerance");
  }
}

}  // namespace

void treemaps(Bytes bytes) {
  Input input(bytes);
  const TreeInput tree = any_tree(input);
  const Ring outline = any_outline(input);
  TreemapOptions options;
  options.threads = 1;
  options.rounds = static_cast<int>(input.below(8));
  options.random_seed = input.byte();
  if (input.below(16) == 15) options.tolerance = input.number();
  if (input.below(8) == 7) options.large_group = input.below(8);
  options.device = shared_device();
  std::vector<double> start;
  accepted(kCallersFaults, [&] {
    for (int layout = 0; layout < 2; ++layout) {
      const Treemap map = treemap(tree.view(), outline, options);
      check(map, tree, options.tolerance);
      start = relative_positions(tree.parent, map.seeds, map.vertex_offset, map.vertices);
      require(start.size() == 2 * tree.parent.size(), "positions of another number than nodes");
      if (input.flag() && !start.empty()) start[input.below(start.size())] = input.number();
      options.start = start;
    }
  });
  // Arrays that are no layout.
  accepted(kCallersFaults, [&] {
    std::vector<std::int64_t> parent(input.below(5));
    for (std::int64_t& p : parent) p = static_cast<std::int64_t>(input.below(7)) - 1;
    std::vector<std::uint64_t> offset(parent.size() + 1);
    for (std::uint64_t& o : offset) o = input.below(9);
    const std::vector<double> seeds = input.numbers(2 * parent.size()),
                              vertices = input.numbers(2 * offset.back());
    relative_positions(parent, seeds, offset, vertices);
  });
}

}  // namespace powercell::fuzz
