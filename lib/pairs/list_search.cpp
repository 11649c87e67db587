#include "lib/pairs/list_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lib/pairs/column_loops.hpp"

namespace powercell::pairs {

namespace {

// Up to this many seeds are all tested against all. With more, the part is split.
constexpr std::size_t few_listed = 32;
// Up to this many are tested against all where splitting does not help.
constexpr std::size_t most_seeds = 128;
// Maximum depth of splits. Long lists come from the tree where splits failed, and may hold clusters far
// smaller than the part.
constexpr std::size_t most_depth = 12, most_depth_of_long = 64;
constexpr std::size_t long_list = 2048;
// Splitting ends after so many splits in a row that exclude few seeds.
constexpr int most_list_failures = 3;

template <int D>
std::array<const double*, D + 1> pointers(const SeedColumns<D>& columns) {
  std::array<const double*, D + 1> to;
  for (std::size_t k = 0; k <= D; ++k) to[k] = columns[k].data();
  return to;
}

/// Sets `place` to those of 0 .. count-1 with no positive excess.
void without_excess(std::size_t count, const std::vector<double>& excess, std::vector<std::uint32_t>& place) {
  place.resize(count);
  std::size_t kept = 0;
  for (std::size_t s = 0; s < count; ++s) {
    place[kept] = static_cast<std::uint32_t>(s);
    kept += excess[s] > 0 ? 0 : 1;
  }
  place.resize(kept);
}

}  // namespace

template <int D>
void ListSearch<D>::narrow(const Point<D>& low, const Point<D>& high, const SeedList<D>& from,
                           SeedList<D>& to) {
  to.clear();
  if (from.size() == 0) return;
  Point<D> size, x;
  for (std::size_t k = 0; k < D; ++k) size[k] = high[k] - low[k];
  for (std::size_t k = 0; k < D; ++k) x[k] = size[k] / 2;
  tester_.clear();
  const auto test_by_owner = [&](const SeedList<D>& list) {
    const auto column = pointers<D>(list.column);
    const std::size_t owner = owner_of(x, {list.size(), column, low.data(), nullptr});
    if (std::find(tester_.begin(), tester_.end(), list.rank[owner]) != tester_.end()) return;
    tester_.push_back(list.rank[owner]);
    std::array<double, D + 1> tester;
    for (std::size_t k = 0; k < D; ++k) tester[k] = column[k][owner] - low[k];
    tester[D] = column[D][owner];
    loops::raise_box_excess(list.size(), D, column.data(), low.data(), size.data(), tester.data(),
                            excess_.data());
  };
  // The owner of the middle excludes seeds far away, which shortens the lists for the other owners.
  excess_.assign(from.size(), 0.0);
  test_by_owner(from);
  without_excess(from.size(), excess_, kept_);
  near_.pick(from, kept_);
  excess_.assign(near_.size(), 0.0);
  for (std::size_t v = 0; v < std::size_t{1} << D; ++v) {
    for (std::size_t k = 0; k < D; ++k) x[k] = (v >> k & 1) != 0 ? size[k] : 0.0;
    test_by_owner(near_);
  }
  without_excess(near_.size(), excess_, kept_);
  to.pick(near_, kept_);
}

/// The place of the seed of least power distance at x.
template <int D>
std::size_t ListSearch<D>::owner_of(const Point<D>& x, const Source& from) {
  power_.resize(from.count);
  loops::powers(from.count, D, from.column.data(), from.origin, x.data(), 0, 0, 0, power_.data());
  return loops::least(from.count, power_.data());
}

template <int D>
void ListSearch<D>::begin(const SeedList<D>& seeds, const double* origin, double reach) {
  seeds_ = &seeds;
  reach_ = reach;
  marked_.assign(seeds.size(), 0);
  all_ = {seeds.size(), pointers<D>(seeds.column), origin, nullptr};
}

template <int D>
typename ListSearch<D>::Source ListSearch<D>::source_of(const Subset& subset) {
  static constexpr std::array<double, D> zero{};
  return {subset.count(), pointers<D>(subset.local), zero.data(), &subset};
}

template <int D>
void ListSearch<D>::search(const Part<D>& part, std::span<const CornerValues> known) {
  if (seeds_->size() == 0) return;
  bounds_ = PowerBounds(reach_, part.radius());
  root_.part = part;
  narrow_to(all_, known, root_);
  visit(root_, 0, 0);
}

template <int D>
void ListSearch<D>::append_marked(std::vector<std::uint32_t>& ranks) const {
  for (std::size_t s = 0; s < marked_.size(); ++s)
    if (marked_[s] != 0) ranks.push_back(seeds_->rank[s]);
}

template <int D>
void ListSearch<D>::visit(Subset& subset, std::size_t depth, int failures) {
  const std::size_t most = seeds_->size() > long_list ? most_depth_of_long : most_depth;
  if (subset.count() <= few_listed || depth == most || failures == most_list_failures) return finish(subset);
  if (halves_.size() == depth) halves_.emplace_back();
  Halves& halves = halves_[depth];
  std::tie(halves.first.part, halves.second.part) = split(subset.part);
  narrow_to(source_of(subset), {}, halves.first);
  narrow_to(source_of(subset), {}, halves.second);
  const bool helped = halves.first.count() + halves.second.count() < subset.count() + subset.count() / 5 * 4;
  visit(halves.first, depth + 1, helped ? 0 : failures + 1);
  visit(halves.second, depth + 1, helped ? 0 : failures + 1);
}

template <int D>
void ListSearch<D>::add_tester(const Source& from, const Part<D>& part, std::size_t seed) {
  CornerValues upper;
  for (std::size_t v = 0; v < part.corners; ++v) {
    double square = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const double t = (from.column[k][seed] - from.origin[k]) - part.corner[v][k];
      square += t * t;
    }
    upper[v] = bounds_.upper(square, from.column[D][seed]);
    if (!std::isfinite(upper[v])) return;
  }
  loops::raise_excess(from.count, part.corners, lower_.data(), upper.data(), excess_.data());
}

/// Excludes by the seed of least power at the centroid and, if that leaves many, at the corners.
template <int D>
void ListSearch<D>::narrow_to(const Source& from, std::span<const CornerValues> known, Subset& half) {
  find_bounds(from, half.part);
  excess_.assign(from.count, 0.0);
  tester_.assign(1, static_cast<std::uint32_t>(owner_of(half.part.centroid(), from)));
  add_tester(from, half.part, tester_.front());
  for (const CornerValues& upper : known)
    loops::raise_excess(from.count, half.part.corners, lower_.data(), upper.data(), excess_.data());
  without_excess(from.count, excess_, kept_);
  if (kept_.size() > few_listed) {
    for (std::size_t v = 0; v < half.part.corners; ++v) {
      const auto least = static_cast<std::uint32_t>(loops::least(from.count, lower_[v]));
      if (std::find(tester_.begin(), tester_.end(), least) != tester_.end()) continue;
      tester_.push_back(least);
      add_tester(from, half.part, least);
    }
    without_excess(from.count, excess_, kept_);
  }
  keep_unexcluded(from, half);
}

/// Sets lower_ for the corners of the part, reusing the columns of corners that the source has.
template <int D>
void ListSearch<D>::find_bounds(const Source& from, const Part<D>& part) {
  const std::size_t known = from.subset != nullptr ? from.subset->part.corners : 0;
  for (std::size_t v = 0; v < part.corners; ++v) {
    std::size_t at = 0;
    while (at < known && from.subset->part.corner[at] != part.corner[v]) ++at;
    if (at < known) {
      lower_[v] = from.subset->lower[at].data();
      continue;
    }
    fresh_[v].resize(from.count);
    bounds_.lower_column(from.count, D, from.column.data(), from.origin, part.corner[v].data(),
                         fresh_[v].data());
    lower_[v] = fresh_[v].data();
  }
}

/// Sets the seeds of `half` to those at the places kept_.
template <int D>
void ListSearch<D>::keep_unexcluded(const Source& from, Subset& half) {
  const std::size_t kept = kept_.size();
  half.index.resize(kept);
  for (std::size_t s = 0; s < kept; ++s)
    half.index[s] = from.subset != nullptr ? from.subset->index[kept_[s]] : kept_[s];
  const auto pick = [&](const double* values, double origin, std::vector<double>& to) {
    to.resize(kept);
    for (std::size_t s = 0; s < kept; ++s) to[s] = values[kept_[s]] - origin;
  };
  for (std::size_t k = 0; k < D; ++k) pick(from.column[k], from.origin[k], half.local[k]);
  pick(from.column[D], 0, half.local[D]);
  for (std::size_t v = 0; v < half.part.corners; ++v) pick(lower_[v], 0, half.lower[v]);
}

/// Marks the seeds that no other excludes. Excluded seeds need no test as testers: the seed that excludes one
/// also excludes all that it would exclude.
template <int D>
void ListSearch<D>::finish(Subset& subset) {
  const std::size_t count = subset.count();
  for (std::size_t v = 0; v < subset.part.corners; ++v) lower_[v] = subset.lower[v].data();
  excess_.assign(count, 0.0);
  if (count <= most_seeds)
    for (std::size_t s = 0; s < count; ++s)
      if (!(excess_[s] > 0)) add_tester(source_of(subset), subset.part, s);
  for (std::size_t s = 0; s < count; ++s)
    if (!(excess_[s] > 0)) marked_[subset.index[s]] = 1;
}

template class ListSearch<2>;
template class ListSearch<3>;

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
