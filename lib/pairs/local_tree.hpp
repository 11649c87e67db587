/// \file
/// The packed tree relative to an origin near a region: distances, bounds, nearest seed in power distance.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "lib/pairs/exclusion.hpp"
#include "lib/seeds/packed_tree.hpp"

namespace powercell::pairs {

/// A seed (level -1, index = rank) or node `index` of a level of the packed tree.
struct Entry {
  std::uint32_t index;
  std::int8_t level;
  bool accepted;  ///< all its seeds are candidates already; it stays because they may exclude others

  bool is_seed() const { return level < 0; }
};

/// Disjoint entries that contain all seeds not yet excluded.
using Frontier = std::vector<Entry>;

/// Ranks [begin, end).
struct RankRange {
  std::uint32_t begin, end;
};

inline Frontier root_frontier(const PackedTree& tree) {
  return {{0, static_cast<std::int8_t>(tree.levels() - 1), false}};
}

/// The seeds below an entry.
inline RankRange ranks(const PackedTree& tree, Entry e) {
  if (e.is_seed()) return {e.index, e.index + 1};
  const std::uint64_t width = std::uint64_t{PackedTree::fan} << (3 * e.level);  // fan^(level + 1)
  const std::uint64_t begin = e.index * width;
  return {static_cast<std::uint32_t>(begin),
          static_cast<std::uint32_t>(std::min<std::uint64_t>(begin + width, tree.seeds))};
}
static_assert(PackedTree::fan == 8, "ranks() counts in powers of 8");

/// Calls body(child) for the children of a node.
/// \pre not e.is_seed()
template <class Body>
void for_children(const PackedTree& tree, Entry e, const Body& body) {
  const std::size_t below = e.level == 0 ? tree.seeds
                                         : tree.level_offset[static_cast<std::size_t>(e.level)] -
                                               tree.level_offset[static_cast<std::size_t>(e.level) - 1];
  const std::size_t first = std::size_t{e.index} * PackedTree::fan;
  const std::size_t last = std::min(first + PackedTree::fan, below);
  for (std::size_t k = first; k < last; ++k)
    body(Entry{static_cast<std::uint32_t>(k), static_cast<std::int8_t>(e.level - 1), false});
}

/// Coordinates are relative to `origin` and weights to `reference`, so that neither a domain far from zero
/// nor a constant added to all weights causes cancellation.
template <int D>
class LocalTree {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Least {
    double power = std::numeric_limits<double>::infinity();
    std::uint32_t rank = none;
  };

  LocalTree(const SeedSet& seeds, const PackedTree& tree, double reference)
      : seeds_(seeds), tree_(tree), reference_(reference) {}

  void set_origin(const double* origin) { std::copy_n(origin, D, origin_.begin()); }
  const PackedTree& tree() const { return tree_; }

  struct Box {
    Point<D> low, high;
    double weight;  // the largest of its seeds
  };
  Box box(Entry e) const {
    const double *low, *high;
    Box box;
    if (e.is_seed()) {
      low = high = &seeds_.positions[std::size_t{e.index} * D];
      box.weight = seeds_.weights[e.index] - reference_;
    } else {
      const std::size_t node = tree_.level_offset[static_cast<std::size_t>(e.level)] + std::size_t{e.index};
      low = &tree_.low[node * D];
      high = &tree_.high[node * D];
      box.weight = tree_.weight[node] - reference_;
    }
    for (std::size_t k = 0; k < D; ++k) {
      box.low[k] = low[k] - origin_[k];
      box.high[k] = high[k] - origin_[k];
    }
    return box;
  }

  static double squared_distance_to(const Box& box, const Point<D>& x) {
    double sum = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const double t = std::max(0.0, std::max(box.low[k] - x[k], x[k] - box.high[k]));
      sum += t * t;
    }
    return sum;
  }

  /// Lower bounds of the power distances of all seeds below `e` at the corners of `part`.
  CornerValues lower(Entry e, const Part<D>& part, const PowerBounds& bounds) const {
    const Box b = box(e);
    CornerValues values;
    for (std::size_t v = 0; v < part.corners; ++v)
      values[v] = bounds.lower(squared_distance_to(b, part.corner[v]), b.weight);
    return values;
  }
  CornerValues upper(std::uint32_t rank, const Part<D>& part, const PowerBounds& bounds) const {
    const Box b = box(Entry{rank, -1, false});
    CornerValues values;
    for (std::size_t v = 0; v < part.corners; ++v)
      values[v] = bounds.upper(squared_distance_to(b, part.corner[v]), b.weight);
    return values;
  }

  double power(Entry e, const Point<D>& x) const {
    const Box b = box(e);
    return squared_distance_to(b, x) - b.weight;
  }

  /// The seed below the frontier of least power distance at `x` if that is less than `least`, else `least`.
  /// Ties may go either way: testers need not be nearest.
  Least least_power(const Point<D>& x, const Frontier& frontier, Least least) {
    queue_.clear();
    for (const Entry e : frontier) {
      const double bound = power(e, x);
      if (!(bound < least.power)) continue;
      if (e.is_seed())
        least = {bound, e.index};
      else
        queue_.push_back({bound, e});
    }
    // Most of the queue is never read, so the least is extracted as needed instead of sorting.
    while (!queue_.empty()) {
      const auto next = std::min_element(queue_.begin(), queue_.end());
      const Bounded node = *next;
      *next = queue_.back();
      queue_.pop_back();
      if (!(node.bound < least.power)) break;
      descend(node.entry, x, least);
    }
    return least;
  }

 private:
  struct Bounded {
    double bound;
    Entry entry;
    bool operator<(const Bounded& other) const { return bound < other.bound; }
  };

  void descend(Entry e, const Point<D>& x, Least& least) const {
    std::array<Bounded, PackedTree::fan> child;  // ascending
    std::size_t count = 0;
    for_children(tree_, e, [&](Entry c) {
      const double bound = power(c, x);
      if (!(bound < least.power)) return;
      if (c.is_seed()) {
        least = {bound, c.index};
        return;
      }
      std::size_t at = count++;
      for (; at > 0 && bound < child[at - 1].bound; --at) child[at] = child[at - 1];
      child[at] = {bound, c};
    });
    for (std::size_t k = 0; k < count && child[k].bound < least.power; ++k) descend(child[k].entry, x, least);
  }

  const SeedSet& seeds_;
  const PackedTree& tree_;
  double reference_;
  Point<D> origin_{};
  std::vector<Bounded> queue_;
};

}  // namespace powercell::pairs
