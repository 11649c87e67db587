/// \file
/// Which nodes of the packed tree can hold seeds that meet a box. Internal.
#pragma once

#include <vector>

#include "lib/pairs/local_tree.hpp"
#include "lib/pairs/part.hpp"

namespace powercell::pairs {

/// One worker's search with its scratch memory; not thread-safe.
template <int D>
class NodeSearch {
 public:
  /// Keeps a reference to the tree, whose origin it moves.
  explicit NodeSearch(LocalTree<D>& tree) : tree_(tree) {}

  /// From the seeds below `from`, nodes of one level, to the nodes of one level that hold all that can meet
  /// the box [low, high]: of so low a level that they are `enough` or hold at most `few` seeds.
  /// \return the number of seeds below them
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
