/// \file
/// Trees for tests of the treemap.
#pragma once

#include <cmath>
#include <powercell/treemap.hpp>

#include "tests/support/generators.hpp"

namespace powercell::test {

/// The unit square.
inline const Ring square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

struct MadeTree {
  std::vector<std::int64_t> parent = {TreeView::no_parent};
  std::vector<double> value = {0};

  std::size_t add(std::size_t under, double own) {
    parent.push_back(static_cast<std::int64_t>(under));
    value.push_back(own);
    return parent.size() - 1;
  }
  TreeView view() const { return {parent, value}; }
};

/// A root with n children whose logarithms of values are uniform over a factor `range`.
inline MadeTree flat_tree(std::size_t n, double range, Random& random) {
  MadeTree tree;
  for (std::size_t i = 0; i < n; ++i) tree.add(0, std::pow(range, random.uniform()));
  return tree;
}

/// n nodes below the root, each a child of a random one of the last `breadth` nodes.
inline MadeTree random_tree(std::size_t n, std::size_t breadth, double range, Random& random) {
  MadeTree tree;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t size = tree.parent.size(), reach = std::min(breadth, size);
    tree.add(size - 1 - random.index(reach), std::pow(range, random.uniform()));
  }
  return tree;
}

}  // namespace powercell::test
