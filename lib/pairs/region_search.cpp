#include "lib/pairs/region_search.hpp"

#include <algorithm>
#include <atomic>
#include <deque>
#include <limits>
#include <powercell/error.hpp>

#include "lib/base/threads.hpp"
#include "lib/pairs/candidate_search.hpp"

namespace powercell::pairs {
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
    if (w == 0 && search.progress && !search.progress(share))
      throw Error(ErrorCode::interrupted,
                  "stopped by the progress callback while finding the seeds that meet regions");
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
