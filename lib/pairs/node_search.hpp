/// \file
/// The nodes of the packed tree that can hold seeds meeting a box. Internal.
#pragma once

#include <vector>

#include "lib/pairs/local_tree.hpp"
#include "lib/pairs/part.hpp"

namespace powercell::pairs {

/// The search of one thread, with its scratch memory.
template <int D>
class NodeSearch {
 public:
  /// Keeps a reference to the tree, and changes its origin.
  explicit NodeSearch(LocalTree<D>& tree) : tree_(tree) {}

  /// Sets `to` to the nodes of one level below `from` that hold all seeds that can meet the box [low, high]:
  /// the highest level with at least `min_nodes` such nodes or at most `max_seeds` seeds below them.
  /// \param from  nodes of one level
  /// \return the number of seeds below `to`
  std::uint64_t narrow(const Point<D>& low, const Point<D>& high, const Frontier& from, std::size_t min_nodes,
                       std::uint64_t max_seeds, Frontier& to);

 private:
  void choose_testers(const Point<D>& size, const Frontier& from);
  void keep_unexcluded(const Point<D>& size, Frontier& nodes);
  std::uint64_t seeds_below(const Frontier& nodes) const;

  LocalTree<D>& tree_;
  std::vector<std::uint32_t> tester_;
  std::array<std::vector<double>, 2 * D + 1> column_;  // low and high coordinates, largest weight
  std::vector<double> excess_;
};

extern template class NodeSearch<2>;
extern template class NodeSearch<3>;

}  // namespace powercell::pairs
