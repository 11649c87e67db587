#include "lib/pairs/enumerate.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <powercell/error.hpp>

#include "lib/pairs/candidate_search.hpp"
#include "lib/pairs/region_groups.hpp"
#include "lib/pairs/transpose.hpp"
#include "lib/seeds/threads.hpp"

namespace powercell {
namespace pairs {
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

/// The candidates of consecutive regions in curve order.
struct Task {
  std::vector<std::uint32_t> ranks;  ///< region after region
  std::vector<std::uint64_t> end;    ///< per region: end of its ranks
};

template <int D>
class Worker {
 public:
  Worker(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, double reference,
         const RegionGroups& groups)
      : groups_(groups),
        search_(mesh, seeds, tree, reference),
        narrowed_(groups.level.size() + 1),
        group_(groups.level.size() + 1, none) {
    narrowed_.back().frontier = root_frontier(tree);
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
      search_.narrow(low, high, from, narrowed_[level]);
      group_[level] = group;
    }
    return narrowed_[level];
  }

  const RegionGroups& groups_;
  CandidateSearch<D> search_;
  std::vector<Narrowed<D>> narrowed_;  // by level; above the last one are all seeds
  std::vector<std::size_t> group_;     // whose they are
};

template <int D>
Pairs search_all(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, int threads,
                 const std::function<bool(double)>& progress) {
  const RegionGroups groups(mesh, threads);
  const std::size_t regions = groups.order.size();
  const double reference = typical_weight(seeds.weights);
  std::vector<Task> tasks((regions + task_size - 1) / task_size);
  std::vector<Worker<D>> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int w = 0; w < threads; ++w) workers.emplace_back(mesh, seeds, tree, reference, groups);

  std::atomic<std::size_t> done{0};
  parallel_tasks(threads, tasks.size(), [&](int w, std::size_t t) {
    const std::size_t first = t * task_size;
    workers[static_cast<std::size_t>(w)].run(first, std::min(first + task_size, regions), tasks[t]);
    const std::size_t count = ++done;
    // Only the calling thread, which is worker 0, calls back.
    if (w == 0 && progress && !progress(static_cast<double>(count) / static_cast<double>(tasks.size())))
      throw Error(ErrorCode::interrupted,
                  "stopped by the progress callback while seeking which seeds meet "
                  "which regions");
  });

  std::vector<RankList> lists(regions);
  for (std::size_t k = 0; k < regions; ++k) {
    const Task& task = tasks[k / task_size];
    const std::size_t row = k % task_size;
    const std::uint64_t begin = row == 0 ? 0 : task.end[row - 1];
    lists[groups.order[k]] = {task.ranks.data() + begin, static_cast<std::uint32_t>(task.end[row] - begin)};
  }
  return transpose(lists, seeds.size(), threads);
}

/// One region meets them all, as far as anybody can tell more cheaply than by clipping.
Pairs all_with_one_region(std::size_t seeds) {
  Pairs pairs;
  pairs.offset.resize(seeds + 1);
  std::iota(pairs.offset.begin(), pairs.offset.end(), std::uint64_t{0});
  pairs.region.assign(seeds, 0);
  return pairs;
}

}  // namespace
}  // namespace pairs

Pairs enumerate_pairs(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, int threads,
                      const std::function<bool(double)>& progress) {
  if (mesh.region_count() == 1) return pairs::all_with_one_region(seeds.size());
  if (mesh.region_count() == 0 || seeds.size() == 0) {
    Pairs none;
    none.offset.assign(seeds.size() + 1, 0);
    return none;
  }
  const int workers = thread_count(threads);
  return mesh.dimension == 2 ? pairs::search_all<2>(mesh, seeds, tree, workers, progress)
                             : pairs::search_all<3>(mesh, seeds, tree, workers, progress);
}

}  // namespace powercell
