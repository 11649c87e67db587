#include "lib/pairs/candidate_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <limits>
#include <powercell/error.hpp>
#include <tuple>

#include "lib/base/progress.hpp"
#include "lib/base/threads.hpp"

namespace powercell::pairs {

namespace {

// Up to this many undecided seeds are put in a list and tested at once.
constexpr std::uint64_t few_seeds = 2048;
// The same after splits that excluded few seeds. There weights vary with the position, as those of seeds far
// outside whose cells lie in the domain, and all nodes of the tree are too coarse.
constexpr std::uint64_t few_after_failures = std::uint64_t{1} << 18;
// Number of entries to which a frontier is expanded. Fewer exclude less, more cost time in each part.
constexpr std::size_t min_entries_of_part = 32;
constexpr std::size_t min_entries_of_box = 64;
// Splitting ends after so many splits in a row that exclude few seeds.
constexpr int most_failures = 5;

}  // namespace

template <int D>
void CandidateSearch<D>::narrow(const Point<D>& low, const Point<D>& high, const Narrowed<D>& from,
                                Narrowed<D>& to) {
  to.listed = true;
  if (from.listed) return list_search_.narrow(low, high, from.list, to.list);
  to.listed =
      node_search_.narrow(low, high, from.frontier, min_entries_of_box, few_seeds, to.frontier) <= few_seeds;
  if (!to.listed) return;
  gather(to.frontier, few_);
  list_search_.narrow(low, high, few_, to.list);
}

template <int D>
void CandidateSearch<D>::find(std::uint32_t region, const Narrowed<D>& from,
                              std::vector<std::uint32_t>& ranks) {
  set_region(region);
  if (from.listed) {
    if (from.list.size() == 1) return ranks.push_back(from.list.rank.front());
    list_search_.begin(from.list, origin_, reach_);
    for_parts(corners_, [&] { list_search_.search(root_.part); });
    return list_search_.append_marked(ranks);
  }
  tree_.set_origin(origin_);
  interior_.set(corners_, mesh_);
  found_.clear();
  for_parts(corners_, [&] { search(from.frontier); });
  // Parts share candidates, and several parts may accept a node.
  std::sort(found_.begin(), found_.end(), [](RankRange a, RankRange b) { return a.begin < b.begin; });
  std::uint32_t next = 0;
  for (const RankRange range : found_)
    for (next = std::max(next, range.begin); next < range.end; ++next) ranks.push_back(next);
}

/// Calls body() with root_.part set to each part of the region. Polygons with too many corners for a Part are
/// halved by chords, without a test.
template <int D>
template <class Body>
void CandidateSearch<D>::for_parts(std::span<const Point<D>> corners, const Body& body) {
  const std::size_t count = corners.size();
  if (count <= most_corners) {
    root_.part.shape = mesh_.shape == RegionShape::polygon ? PartShape::polygon
                       : mesh_.shape == RegionShape::box   ? PartShape::box
                                                           : PartShape::tetrahedron;
    root_.part.corners = count;
    std::copy(corners.begin(), corners.end(), root_.part.corner.begin());
    return body();
  }
  for_parts(corners.first(count / 2 + 1), body);
  std::vector<Point<D>> rest(corners.begin() + static_cast<std::ptrdiff_t>(count / 2), corners.end());
  rest.push_back(corners.front());
  for_parts(rest, body);
}

/// Sets `list` to the undecided seeds below a frontier.
template <int D>
void CandidateSearch<D>::gather(const Frontier& frontier, SeedList<D>& list) {
  gathered_.clear();
  for (const Entry e : frontier)
    if (!e.accepted) gathered_.push_back(ranks(tree_.tree(), e));
  std::sort(gathered_.begin(), gathered_.end(), [](RankRange a, RankRange b) { return a.begin < b.begin; });
  list.clear();
  for (const RankRange range : gathered_)
    for (std::uint32_t rank = range.begin; rank < range.end; ++rank) list.add(seeds_, rank, reference_);
}

template <int D>
void CandidateSearch<D>::set_region(std::uint32_t region) {
  const std::uint32_t first = mesh_.region_offset[region], last = mesh_.region_offset[region + 1];
  origin_ = &mesh_.vertices[std::size_t{mesh_.region_vertex[first]} * D];
  corners_.resize(last - first);
  reach_ = 0;
  for (std::uint32_t slot = first; slot < last; ++slot) {
    const double* x = &mesh_.vertices[std::size_t{mesh_.region_vertex[slot]} * D];
    Point<D>& corner = corners_[slot - first];
    for (std::size_t k = 0; k < D; ++k) corner[k] = x[k] - origin_[k];
    reach_ = std::max(reach_, squared_distance<D>(corner, Point<D>{}));
  }
  reach_ = std::sqrt(reach_);
}

template <int D>
void CandidateSearch<D>::search(const Frontier& from) {
  refine(root_, from, Testers{}, min_entries_of_part);
  steps_left_ = 256 + root_.undecided / 2;
  visit(root_, 0, 0);
}

/// Decides a refined part, or splits it. `failures` counts the splits in a row above it whose halves kept
/// nearly all seeds, as where more cells meet in a point than splitting can separate.
template <int D>
void CandidateSearch<D>::visit(Step& step, std::size_t depth, int failures) {
  if (step.undecided == 0) return;
  if (step.undecided <= (failures < 2 ? few_seeds : few_after_failures) || depth == most_splits ||
      failures == most_failures || steps_left_ < 2)
    return finish(step);
  steps_left_ -= 2;
  if (halves_.size() == depth) halves_.emplace_back();
  Halves& halves = halves_[depth];
  std::tie(halves.first.part, halves.second.part) = split(step.part);
  // Where splitting does not help, nodes may be too coarse for the spread of their weights.
  const std::size_t min_entries = min_entries_of_part << failures;
  refine(halves.first, step.frontier, step.testers, min_entries);
  refine(halves.second, step.frontier, step.testers, min_entries);
  const bool helped =
      halves.first.undecided + halves.second.undecided < step.undecided + step.undecided / 5 * 4;
  visit(halves.first, depth + 1, helped ? 0 : failures + 1);
  visit(halves.second, depth + 1, helped ? 0 : failures + 1);
}

/// Sets the frontier of `step` to the entries of `from` that its part does not exclude. The seeds of `known`
/// are tried as testers.
template <int D>
void CandidateSearch<D>::refine(Step& step, const Frontier& from, const Testers& known,
                                std::size_t min_entries) {
  step.bounds = PowerBounds(reach_, step.part.radius());
  step.frontier.clear();
  step.undecided = 0;
  choose_testers(step, from, known);
  for (const Entry e : from) keep_unless_excluded(step, e, &step == &root_);
  expand(step, min_entries);
}

template <int D>
void CandidateSearch<D>::choose_testers(Step& step, const Frontier& from, const Testers& known) {
  using Least = typename LocalTree<D>::Least;
  step.testers.clear();
  const auto choose_at = [&](const Point<D>& x) {
    Least least;
    const auto consider = [&](std::uint32_t rank) {
      const double power = tree_.power(Entry{rank, -1, false}, x);
      if (power < least.power) least = {power, rank};
    };
    for (const Tester& t : known) consider(t.rank);
    for (const Tester& t : step.testers) consider(t.rank);
    least = tree_.least_power(x, from, least);
    if (least.rank != LocalTree<D>::none && !step.testers.contains(least.rank))
      step.testers.add({least.rank, tree_.upper(least.rank, step.part, step.bounds)});
  };
  choose_at(step.part.centroid());
  for (std::size_t v = 0; v < step.part.corners; ++v) choose_at(step.part.corner[v]);
}

/// Adds `entry` to the frontier unless it is excluded. Accepts a new node that lies inside the region without
/// further tests: a seed in the region nearly always meets it, and each seed lies in one region.
template <int D>
void CandidateSearch<D>::keep_unless_excluded(Step& step, Entry entry, bool is_new) {
  if (excluded(step.testers, tree_.lower(entry, step.part, step.bounds), step.part.corners)) return;
  if (is_new && !entry.accepted && !entry.is_seed()) {
    const auto box = tree_.box(entry);
    if (interior_.contains(box.low, box.high)) {
      entry.accepted = true;
      found_.push_back(ranks(tree_.tree(), entry));
    }
  }
  step.frontier.push_back(entry);
  if (!entry.accepted) {
    const RankRange range = ranks(tree_.tree(), entry);
    step.undecided += range.end - range.begin;
  }
}

/// Replaces undecided nodes by their children, the largest first, until there are `min_entries` entries or
/// all undecided ones are seeds.
template <int D>
void CandidateSearch<D>::expand(Step& step, std::size_t min_entries) {
  while (step.frontier.size() < min_entries) {
    int level = -1;
    for (const Entry e : step.frontier)
      if (!e.accepted) level = std::max<int>(level, e.level);
    if (level < 0) return;
    expanding_.swap(step.frontier);
    step.frontier.clear();
    for (const Entry e : expanding_) {
      if (e.accepted || e.level != level) {
        step.frontier.push_back(e);
        continue;
      }
      const RankRange range = ranks(tree_.tree(), e);
      step.undecided -= range.end - range.begin;
      for_children(tree_.tree(), e, [&](Entry child) { keep_unless_excluded(step, child, true); });
    }
  }
}

/// Appends the undecided seeds to found_; if they are few, only those that no other seed excludes.
template <int D>
void CandidateSearch<D>::finish(Step& step) {
  if (step.undecided <= few_after_failures) {
    gather(step.frontier, few_);
    testers_.clear();
    for (const Tester& t : step.testers) testers_.push_back(t.upper);
    list_search_.begin(few_, origin_, reach_);
    list_search_.search(step.part, testers_);
    ranks_.clear();
    list_search_.append_marked(ranks_);
    for (const std::uint32_t rank : ranks_) found_.push_back({rank, rank + 1});
    return;
  }
  const auto undecided_node = [](Entry e) { return !e.accepted && !e.is_seed(); };
  while (std::any_of(step.frontier.begin(), step.frontier.end(), undecided_node))
    expand(step, step.frontier.size() + 1);
  for (const Entry e : step.frontier)
    if (!e.accepted) found_.push_back(ranks(tree_.tree(), e));
}

template class CandidateSearch<2>;
template class CandidateSearch<3>;

namespace {

/// The median of a sample of weights: a reference that a few heavy seeds do not affect.
double typical_weight(const std::vector<double>& weights) {
  constexpr std::size_t samples = 1001;
  std::vector<double> sample;
  const std::size_t step = std::max<std::size_t>(weights.size() / samples, 1);
  for (std::size_t i = 0; i < weights.size(); i += step) sample.push_back(weights[i]);
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}

/// Regions of one task: few enough to balance the threads, many enough that narrowing anew does not cost
/// much.
constexpr std::size_t task_size = 64;

using Task = RegionLists::Task;

template <int D>
class Worker {
 public:
  Worker(const RegionSearchInput& search, double reference)
      : groups_(search.groups),
        search_(search.mesh, search.seeds, search.tree, reference),
        narrowed_(groups_.level.size() + 1),
        group_(groups_.level.size() + 1, none) {
    narrowed_.back().frontier = root_frontier(search.tree);
  }

  void run(std::size_t first, std::size_t last, Task& task) {
    for (std::size_t k = first; k < last; ++k) {
      search_.find(groups_.order[k], narrowed(1, k / RegionGroups::fan), task.ranks);
      task.end.push_back(task.ranks.size());
    }
    task.ranks.shrink_to_fit();
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// The seeds of the parent group that can meet the group's box, so that seeds far from all members are
  /// excluded once. They depend on the groups, not on the tasks, so the result does not depend on the
  /// threads.
  const Narrowed<D>& narrowed(std::size_t level, std::size_t group) {
    if (level + 1 >= narrowed_.size()) return narrowed_.back();
    if (group_[level] != group) {
      const Narrowed<D>& from = narrowed(level + 1, group / RegionGroups::fan);
      const RegionGroups::Boxes& boxes = groups_.level[level];
      Point<D> low, high;
      std::copy_n(&boxes.low[group * D], D, low.begin());
      std::copy_n(&boxes.high[group * D], D, high.begin());
      group_[level] = group;
      search_.narrow(low, high, from, narrowed_[level]);
    }
    return narrowed_[level];
  }

  const RegionGroups& groups_;
  CandidateSearch<D> search_;
  std::vector<Narrowed<D>> narrowed_;  // per level of groups, then all seeds
  std::vector<std::size_t> group_;     // per level: the group that narrowed_ is for
};

template <int D>
RegionLists search_all(const RegionSearchInput& search) {
  const std::size_t regions = search.groups.order.size();
  const double reference = typical_weight(search.seeds.weights);
  RegionLists found;
  found.tasks.resize((regions + task_size - 1) / task_size);
  std::deque<Worker<D>> workers;
  for (int w = 0; w < search.threads; ++w) workers.emplace_back(search, reference);

  std::atomic<std::size_t> done{0};
  parallel_tasks(search.threads, found.tasks.size(), [&](int w, std::size_t t) {
    const std::size_t first = t * task_size, last = std::min(first + task_size, regions);
    workers[static_cast<std::size_t>(w)].run(first, last, found.tasks[t]);
    const double share = static_cast<double>(++done) / static_cast<double>(found.tasks.size());
    // The callback runs on the calling thread only, which is worker 0.
    if (w == 0) report_progress(search.progress, share, 1);
  });

  found.list.resize(regions);
  for (std::size_t k = 0; k < regions; ++k) {
    const Task& task = found.tasks[k / task_size];
    const std::size_t row = k % task_size;
    const std::uint64_t begin = row == 0 ? 0 : task.end[row - 1];
    found.list[search.groups.order[k]] = {task.ranks.data() + begin,
                                          static_cast<std::uint32_t>(task.end[row] - begin)};
  }
  return found;
}

}  // namespace

RegionLists search_regions(const RegionSearchInput& search) {
  if (search.seeds.size() == 0) return {{}, std::vector<RankList>(search.mesh.region_count())};
  return search.mesh.dimension == 2 ? search_all<2>(search) : search_all<3>(search);
}

}  // namespace powercell::pairs
