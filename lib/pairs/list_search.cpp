#include "lib/pairs/list_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "lib/pairs/column_loops.hpp"

namespace powercell::pairs {
namespace {

// Of at most this many seeds all are tried against all; of more, the part is split.
constexpr std::size_t few_seeds = 32;
// All against all is also the last resort where splitting does not help, up to this many.
constexpr std::size_t most_seeds = 128;
constexpr std::size_t most_depth = 12;
// Splits in a row that may fail to thin out the seeds before splitting is given up.
constexpr int most_failures = 3;

template <int D>
std::array<const double*, D + 1> pointers(const SeedColumns<D>& columns) {
  std::array<const double*, D + 1> to;
  for (std::size_t k = 0; k <= D; ++k) to[k] = columns[k].data();
  return to;
}

template <int D>
double radius(const Part<D>& part, const Point<D>& centroid) {
  double most = 0;
  for (std::size_t v = 0; v < part.corners; ++v)
    most = std::max(most, squared_distance<D>(part.corner[v], centroid));
  return std::sqrt(most);
}

template <int D>
void make_local(const SeedList<D>& seeds, const double* origin, SeedColumns<D>& local) {
  for (std::size_t k = 0; k < D; ++k) {
    local[k].resize(seeds.size());
    loops::subtract(seeds.size(), seeds.column[k].data(), origin[k], local[k].data());
  }
  local[D] = seeds.column[D];
}

}  // namespace

template <int D>
void ListSearch<D>::narrow(const Point<D>& low, const Point<D>& high, const SeedList<D>& from,
                           SeedList<D>& to) {
  const std::size_t count = from.size();
  to.clear();
  if (count == 0) return;
  make_local<D>(from, low.data(), local_);
  const auto column = pointers<D>(local_);
  Point<D> size;
  for (std::size_t k = 0; k < D; ++k) size[k] = high[k] - low[k];
  power_.resize(count);
  excess_.assign(count, 0.0);
  tester_.clear();
  const auto test_by_owner = [&](const Point<D>& x) {
    loops::powers(count, D, column.data(), x.data(), 0, 0, 0, power_.data());
    const auto owner = static_cast<std::uint32_t>(loops::least(count, power_.data()));
    if (std::find(tester_.begin(), tester_.end(), owner) != tester_.end()) return;
    tester_.push_back(owner);
    std::array<double, D + 1> tester;
    for (std::size_t k = 0; k <= D; ++k) tester[k] = column[k][owner];
    loops::raise_box_excess(count, D, column.data(), size.data(), tester.data(), excess_.data());
  };
  Point<D> x;
  for (std::size_t k = 0; k < D; ++k) x[k] = size[k] / 2;
  test_by_owner(x);
  for (std::size_t v = 0; v < std::size_t{1} << D; ++v) {
    for (std::size_t k = 0; k < D; ++k) x[k] = (v >> k & 1) != 0 ? size[k] : 0.0;
    test_by_owner(x);
  }
  for (std::size_t s = 0; s < count; ++s)
    if (!(excess_[s] > 0)) to.add(from, s);
}

template <int D>
void ListSearch<D>::begin(const SeedList<D>& seeds, const double* origin, double reach) {
  seeds_ = &seeds;
  reach_ = reach;
  marked_.assign(seeds.size(), 0);
  make_local<D>(seeds, origin, all_.local);
  all_.index.resize(seeds.size());
  for (std::size_t s = 0; s < seeds.size(); ++s) all_.index[s] = static_cast<std::uint32_t>(s);
  all_.part.corners = 0;
}

template <int D>
void ListSearch<D>::search(const Part<D>& part, std::span<const CornerValues> known) {
  if (seeds_->size() == 0) return;
  bounds_ = PowerBounds(reach_, radius<D>(part, part.centroid()));
  root_.part = part;
  narrow_to(all_, known, root_);
  visit(root_, 0, 0);
}

template <int D>
void ListSearch<D>::take_marked(std::vector<std::uint32_t>& ranks) const {
  for (std::size_t s = 0; s < marked_.size(); ++s)
    if (marked_[s] != 0) ranks.push_back(seeds_->rank[s]);
}

template <int D>
void ListSearch<D>::visit(Level& level, std::size_t depth, int failures) {
  if (level.count() <= few_seeds || depth == most_depth || failures == most_failures) return finish(level);
  if (halves_.size() == depth) halves_.emplace_back();
  Halves& halves = halves_[depth];
  std::tie(halves.first.part, halves.second.part) = split(level.part);
  narrow_to(level, {}, halves.first);
  narrow_to(level, {}, halves.second);
  const bool paid = halves.first.count() + halves.second.count() < level.count() + level.count() / 5 * 4;
  visit(halves.first, depth + 1, paid ? 0 : failures + 1);
  visit(halves.second, depth + 1, paid ? 0 : failures + 1);
}

template <int D>
void ListSearch<D>::add_tester(const Level& level, const Part<D>& part, std::size_t seed) {
  CornerValues upper;
  for (std::size_t v = 0; v < part.corners; ++v) {
    double square = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const double t = level.local[k][seed] - part.corner[v][k];
      square += t * t;
    }
    upper[v] = bounds_.upper(square, level.local[D][seed]);
    if (!std::isfinite(upper[v])) return;
  }
  loops::raise_excess(level.count(), part.corners, lower_.data(), upper.data(), excess_.data());
}

/// Excludes by the seeds of least power at the centroid and the corners.
template <int D>
void ListSearch<D>::narrow_to(const Level& level, std::span<const CornerValues> known, Level& half) {
  const std::size_t count = level.count();
  const auto column = pointers<D>(level.local);
  for (std::size_t v = 0; v < half.part.corners; ++v) {
    std::size_t at = 0;
    while (at < level.part.corners && level.part.corner[at] != half.part.corner[v]) ++at;
    lower_[v] = level.lower[at % most_corners].data();
    if (at < level.part.corners) continue;
    fresh_[v].resize(count);
    bounds_.lower_column(count, D, column.data(), half.part.corner[v].data(), fresh_[v].data());
    lower_[v] = fresh_[v].data();
  }
  excess_.assign(count, 0.0);
  power_.resize(count);
  tester_.clear();
  const auto add_once = [&](std::size_t seed) {
    if (std::find(tester_.begin(), tester_.end(), seed) != tester_.end()) return;
    tester_.push_back(static_cast<std::uint32_t>(seed));
    add_tester(level, half.part, seed);
  };
  const Point<D> centroid = half.part.centroid();
  loops::powers(count, D, column.data(), centroid.data(), 0, 0, 0, power_.data());
  add_once(loops::least(count, power_.data()));
  for (std::size_t v = 0; v < half.part.corners; ++v) add_once(loops::least(count, lower_[v]));
  for (const CornerValues& upper : known)
    loops::raise_excess(count, half.part.corners, lower_.data(), upper.data(), excess_.data());
  keep_unexcluded(level, half);
}

template <int D>
void ListSearch<D>::keep_unexcluded(const Level& level, Level& half) {
  const std::size_t count = level.count();
  kept_.resize(count);
  std::size_t kept = 0;
  for (std::size_t s = 0; s < count; ++s) {
    kept_[kept] = static_cast<std::uint32_t>(s);
    kept += excess_[s] > 0 ? 0 : 1;
  }
  const auto pick = [&](const auto* from, auto& to) {
    to.resize(kept);
    for (std::size_t s = 0; s < kept; ++s) to[s] = from[kept_[s]];
  };
  pick(level.index.data(), half.index);
  for (std::size_t k = 0; k <= D; ++k) pick(level.local[k].data(), half.local[k]);
  for (std::size_t v = 0; v < half.part.corners; ++v) pick(lower_[v], half.lower[v]);
}

/// Marks what no other seed excludes. What an excluded seed excludes, the one that excludes it does as well.
template <int D>
void ListSearch<D>::finish(Level& level) {
  const std::size_t count = level.count();
  for (std::size_t v = 0; v < level.part.corners; ++v) lower_[v] = level.lower[v].data();
  excess_.assign(count, 0.0);
  if (count <= most_seeds)
    for (std::size_t s = 0; s < count; ++s)
      if (!(excess_[s] > 0)) add_tester(level, level.part, s);
  for (std::size_t s = 0; s < count; ++s)
    if (!(excess_[s] > 0)) marked_[level.index[s]] = 1;
}

template class ListSearch<2>;
template class ListSearch<3>;

}  // namespace powercell::pairs
