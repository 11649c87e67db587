#include "lib/pairs/enumerate.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <powercell/error.hpp>

#include "lib/pairs/candidate_search.hpp"
#include "lib/pairs/region_order.hpp"
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

/// Regions of one task: a power of 8, few enough that tasks can be shared out. It must not depend on the
/// number of threads: the shape of the search would, and with it which needless pairs stay.
std::size_t task_size(std::size_t regions) {
  std::size_t size = 512;
  while (size > 1 && regions / size < 64) size /= 8;
  return size;
}

/// The candidates of consecutive regions in curve order.
struct Task {
  std::vector<std::uint32_t> ranks;  ///< region after region
  std::vector<std::uint64_t> end;    ///< per region: end of its ranks
};

template <int D>
class Worker {
 public:
  Worker(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, double reference,
         const std::vector<std::uint32_t>& order)
      : mesh_(mesh), order_(order), root_(root_frontier(tree)), search_(mesh, seeds, tree, reference) {}

  void run(std::size_t first, std::size_t last, std::size_t size, Task& task) {
    group(first, last, size, root_, 0, task);
    task.ranks.shrink_to_fit();
  }

 private:
  /// Narrows the seeds down for the box of the regions [first, last) of the order, then for groups of an
  /// eighth, down to single regions: what is far from all is excluded once.
  void group(std::size_t first, std::size_t last, std::size_t size, const Frontier& from, std::size_t depth,
             Task& task) {
    if (size == 1) {
      for (std::size_t k = first; k < last; ++k) {
        search_.find(order_[k], from, task.ranks);
        task.end.push_back(task.ranks.size());
      }
      return;
    }
    Point<D> low, high;
    box(first, last, low, high);
    if (narrowed_.size() == depth) narrowed_.emplace_back();
    search_.narrow(low, high, from, narrowed_[depth]);
    for (std::size_t k = first; k < last; k += size / 8)
      group(k, std::min(k + size / 8, last), size / 8, narrowed_[depth], depth + 1, task);
  }

  void box(std::size_t first, std::size_t last, Point<D>& low, Point<D>& high) const {
    low.fill(std::numeric_limits<double>::infinity());
    high.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t k = first; k < last; ++k)
      for (std::uint32_t s = mesh_.region_offset[order_[k]]; s < mesh_.region_offset[order_[k] + 1]; ++s)
        for (std::size_t axis = 0; axis < D; ++axis) {
          const double x = mesh_.vertices[std::size_t{mesh_.region_vertex[s]} * D + axis];
          low[axis] = std::min(low[axis], x);
          high[axis] = std::max(high[axis], x);
        }
  }

  const RegionMesh& mesh_;
  const std::vector<std::uint32_t>& order_;
  const Frontier root_;
  CandidateSearch<D> search_;
  std::deque<Frontier> narrowed_;  // by depth
};

template <int D>
Pairs search_all(const RegionMesh& mesh, const SeedSet& seeds, const PackedTree& tree, int threads,
                 const std::function<bool(double)>& progress) {
  const std::vector<std::uint32_t> order = region_order(mesh, threads);
  const double reference = typical_weight(seeds.weights);
  const std::size_t size = task_size(order.size());
  std::vector<Task> tasks((order.size() + size - 1) / size);
  std::vector<Worker<D>> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int w = 0; w < threads; ++w) workers.emplace_back(mesh, seeds, tree, reference, order);

  std::atomic<std::size_t> done{0};
  parallel_tasks(threads, tasks.size(), [&](int w, std::size_t t) {
    const std::size_t first = t * size;
    workers[static_cast<std::size_t>(w)].run(first, std::min(first + size, order.size()), size, tasks[t]);
    const std::size_t count = ++done;
    // Only the calling thread, which is worker 0, calls back.
    if (w == 0 && progress && !progress(static_cast<double>(count) / static_cast<double>(tasks.size())))
      throw Error(ErrorCode::interrupted,
                  "stopped by the progress callback while seeking which seeds meet "
                  "which regions");
  });

  std::vector<RankList> lists(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Task& task = tasks[k / size];
    const std::uint64_t begin = k % size == 0 ? 0 : task.end[k % size - 1];
    lists[order[k]] = {task.ranks.data() + begin, static_cast<std::uint32_t>(task.end[k % size] - begin)};
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
