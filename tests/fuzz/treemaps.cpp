// Treemaps of any tree, values and outline: areas are the values, as updates of themselves too.
#include <cmath>
#include <powercell/shapes.hpp>
#include <powercell/treemap.hpp>
#include <string>
#include <vector>

#include "tests/fuzz/laws.hpp"
#include "tests/fuzz/refusals.hpp"
#include "tests/fuzz/treemap_laws.hpp"

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
      check_treemap(map, tree.parent, options.tolerance);
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
