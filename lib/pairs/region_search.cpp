#include "lib/pairs/region_search.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <powercell/error.hpp>

#include "lib/base/threads.hpp"
#include "lib/pairs/candidate_search.hpp"

namespace powercell::pairs {
namespace {

/// The middle of some weights: a reference that one heavy seed does not move.
double typical_weight(const std::vector<double>& weights) {
  constexpr std::size_t samples = 1001;
  std::vector<double> sample;
  const std::size_t step = std::max<std::size_t>(weights.size() / samples, 1);
  for (std::size_t i = 0; i < weights.size(); i += step) sample.push_back(weights[i]);
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}

/// Regions of one task: few enough that tasks can be shared out, more than pay for narrowing anew.
constexpr std::size_t task_size = 64;

using Task = RegionLists::Task;

template <int D>
class Worker {
 public:
  Worker(const RegionSearch& search, double reference, const SeedMarks* wanted, SeedMarks* other)
      : groups_(search.groups),
        wanted_(wanted),
        other_(other),
        search_(search.mesh, search.seeds, search.tree, reference),
        narrowed_(groups_.level.size() + 1),
        quiet_(groups_.level.size() + 1, false),
        group_(groups_.level.size() + 1, none) {
    narrowed_.back().frontier = root_frontier(search.tree);
  }

  void run(std::size_t first, std::size_t last, Task& task) {
    for (std::size_t k = first; k < last; ++k) {
      const Narrowed<D>& from = narrowed(1, k / RegionGroups::fan);
      if (!quiet_[1]) find(groups_.order[k], from, task.ranks);
      task.end.push_back(task.ranks.size());
    }
    task.ranks.shrink_to_fit();
  }

 private:
  void find(std::uint32_t region, const Narrowed<D>& from, std::vector<std::uint32_t>& ranks) {
    const std::size_t begin = ranks.size();
    search_.find(region, from, ranks);
    if (wanted_ == nullptr) return;
    mark_others(std::span(ranks).subspan(begin));
    if (!any_wanted(std::span(ranks).subspan(begin))) ranks.resize(begin);
  }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  /// What the group's box leaves of the seeds that its parent group left: what is far from all is excluded
  /// once. It depends on the groups alone, not on the tasks, so the result does not depend on the threads.
  const Narrowed<D>& narrowed(std::size_t level, std::size_t group) {
    if (level + 1 >= narrowed_.size()) return narrowed_.back();
    if (group_[level] != group) {
      const Narrowed<D>& from = narrowed(level + 1, group / RegionGroups::fan);
      const RegionGroups::Boxes& boxes = groups_.level[level];
      Point<D> low, high;
      std::copy_n(&boxes.low[group * D], D, low.begin());
      std::copy_n(&boxes.high[group * D], D, high.begin());
      group_[level] = group;
      quiet_[level] = quiet_[level + 1];
      if (quiet_[level]) return narrowed_[level];
      search_.narrow(low, high, from, narrowed_[level]);
      quiet_[level] =
          wanted_ != nullptr && narrowed_[level].listed && !any_wanted(narrowed_[level].list.rank);
      if (quiet_[level]) mark_others(narrowed_[level].list.rank);
    }
    return narrowed_[level];
  }

  bool any_wanted(std::span<const std::uint32_t> ranks) const {
    return std::any_of(ranks.begin(), ranks.end(), [&](std::uint32_t rank) { return (*wanted_)[rank]; });
  }
  void mark_others(std::span<const std::uint32_t> ranks) {
    for (const std::uint32_t rank : ranks)
      if (!(*wanted_)[rank]) other_->set(rank);
  }

  const RegionGroups& groups_;
  const SeedMarks* wanted_;
  SeedMarks* other_;
  CandidateSearch<D> search_;
  std::vector<Narrowed<D>> narrowed_;  // by level; above the last one are all seeds
  std::vector<bool> quiet_;            // by level: no seed is wanted, so nothing below matters
  std::vector<std::size_t> group_;     // by level: whose they are
};

template <int D>
RegionLists search_all(const RegionSearch& search, const SeedMarks* wanted, SeedMarks* other) {
  const std::size_t regions = search.groups.order.size();
  const double reference = typical_weight(search.seeds.weights);
  RegionLists found;
  found.tasks.resize((regions + task_size - 1) / task_size);
  std::deque<Worker<D>> workers;
  for (int w = 0; w < search.threads; ++w) workers.emplace_back(search, reference, wanted, other);

  std::atomic<std::size_t> done{0};
  parallel_tasks(search.threads, found.tasks.size(), [&](int w, std::size_t t) {
    const std::size_t first = t * task_size, last = std::min(first + task_size, regions);
    workers[static_cast<std::size_t>(w)].run(first, last, found.tasks[t]);
    const double share = static_cast<double>(++done) / static_cast<double>(found.tasks.size());
    // Only the calling thread, which is worker 0, calls back.
    if (w == 0 && search.progress && !search.progress(share))
      throw Error(ErrorCode::interrupted,
                  "stopped by the progress callback while seeking which seeds meet "
                  "which regions");
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

RegionLists search_regions(const RegionSearch& search, const SeedMarks* wanted, SeedMarks* other) {
  if (search.seeds.size() == 0) return {{}, std::vector<RankList>(search.mesh.region_count())};
  return search.mesh.dimension == 2 ? search_all<2>(search, wanted, other)
                                    : search_all<3>(search, wanted, other);
}

}  // namespace powercell::pairs
