#include "lib/pairs/node_search.hpp"

#include <algorithm>

#include "lib/pairs/column_loops.hpp"

namespace powercell::pairs {

template <int D>
std::uint64_t NodeSearch<D>::narrow(const Point<D>& low, const Point<D>& high, const Frontier& from,
                                    std::size_t min_nodes, std::uint64_t max_seeds, Frontier& to) {
  tree_.set_origin(low.data());
  Point<D> size;
  for (std::size_t k = 0; k < D; ++k) size[k] = high[k] - low[k];
  choose_testers(size, from);
  to = from;
  keep_unexcluded(size, to);
  while (to.size() < min_nodes && !to.empty() && to.front().level > 0 && seeds_below(to) > max_seeds) {
    Frontier children;
    for (const Entry e : to) for_children(tree_.tree(), e, [&](Entry child) { children.push_back(child); });
    to.swap(children);
    keep_unexcluded(size, to);
  }
  return seeds_below(to);
}

template <int D>
std::uint64_t NodeSearch<D>::seeds_below(const Frontier& nodes) const {
  std::uint64_t count = 0;
  for (const Entry e : nodes) {
    const RankRange range = ranks(tree_.tree(), e);
    count += range.end - range.begin;
  }
  return count;
}

/// Sets the testers to the owners of the middle and the corners of the box.
template <int D>
void NodeSearch<D>::choose_testers(const Point<D>& size, const Frontier& from) {
  tester_.clear();
  const auto choose_at = [&](const Point<D>& x) {
    typename LocalTree<D>::Least least;
    for (const std::uint32_t rank : tester_) {
      const double power = tree_.power(Entry{rank, -1, false}, x);
      if (power < least.power) least = {power, rank};
    }
    least = tree_.least_power(x, from, least);
    if (least.rank != LocalTree<D>::none &&
        std::find(tester_.begin(), tester_.end(), least.rank) == tester_.end())
      tester_.push_back(least.rank);
  };
  Point<D> x;
  for (std::size_t k = 0; k < D; ++k) x[k] = size[k] / 2;
  choose_at(x);
  for (std::size_t v = 0; v < std::size_t{1} << D; ++v) {
    for (std::size_t k = 0; k < D; ++k) x[k] = (v >> k & 1) != 0 ? size[k] : 0.0;
    choose_at(x);
  }
}

template <int D>
void NodeSearch<D>::keep_unexcluded(const Point<D>& size, Frontier& nodes) {
  for (std::vector<double>& c : column_) c.resize(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto box = tree_.box(nodes[n]);
    for (std::size_t k = 0; k < D; ++k) {
      column_[k][n] = box.low[k];
      column_[D + k][n] = box.high[k];
    }
    column_[2 * D][n] = box.weight;
  }
  std::array<const double*, 2 * D + 1> column;
  for (std::size_t k = 0; k < column.size(); ++k) column[k] = column_[k].data();
  excess_.assign(nodes.size(), 0.0);
  for (const std::uint32_t rank : tester_) {
    const auto seed = tree_.box(Entry{rank, -1, false});
    std::array<double, D + 1> tester;
    std::copy_n(seed.low.begin(), D, tester.begin());
    tester[D] = seed.weight;
    loops::raise_node_excess(nodes.size(), D, column.data(), size.data(), tester.data(), excess_.data());
  }
  std::size_t kept = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (!(excess_[n] > 0)) nodes[kept++] = nodes[n];
  nodes.resize(kept);
}

template class NodeSearch<2>;
template class NodeSearch<3>;

}  // namespace powercell::pairs
