#include "lib/pairs/cell_search.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <limits>
#include <powercell/error.hpp>

#include "lib/base/progress.hpp"
#include "lib/base/threads.hpp"
#include "lib/base/vectors.hpp"

namespace powercell::pairs {
namespace {

constexpr std::size_t fan = RegionGroups::fan;
constexpr double infinite = std::numeric_limits<double>::infinity();
/// Rounding of a scalar product with coordinates relative to the seed, relative to its terms.
constexpr double rounding = 0x1p-48;

loops::Bisector bisector_of(const SeedSet& seeds, std::uint32_t i, std::uint32_t j) {
  const auto d = static_cast<std::size_t>(seeds.dimension);
  loops::Bisector bisector{};
  double q2 = 0;
  for (std::size_t k = 0; k < d; ++k) {
    bisector.q[k] = seeds.positions[j * d + k] - seeds.positions[i * d + k];
    q2 += bisector.q[k] * bisector.q[k];
  }
  const double dw = seeds.weights[i] - seeds.weights[j];
  bisector.offset = q2 + dw;
  bisector.magnitude = q2 + std::abs(dw);
  return bisector;
}

}  // namespace

void CellSearch::set_bisectors(std::uint32_t rank) {
  bisectors_.clear();
  for (const std::uint32_t j : cells_.of(rank)) bisectors_.push_back(bisector_of(seeds_, rank, j));
}

void CellSearch::find(std::uint32_t rank, const CellHull& hull, std::vector<std::uint32_t>& regions) {
  const std::span<const std::uint32_t> neighbors = cells_.of(rank);
  if (neighbors.size() == 1 && neighbors.front() == rank) return;  // no cell
  const std::size_t begin = regions.size();
  found_ = &regions;
  seed_ = &seeds_.positions[std::size_t{rank} * static_cast<std::size_t>(seeds_.dimension)];
  set_bisectors(rank);
  hull_ = &hull;
  visit(groups_.level.size() - 1, 0, 0, bisectors_.size());
  std::sort(regions.begin() + static_cast<std::ptrdiff_t>(begin), regions.end());
}

void CellSearch::add_all(std::size_t level, std::size_t group) {
  const std::size_t width = std::size_t{1} << (3 * level), first = group * width;
  for (std::size_t k = first; k < std::min(first + width, groups_.order.size()); ++k)
    found_->push_back(groups_.order[k]);
}

bool CellSearch::separated_along(const double* direction, std::uint32_t region) const {
  const auto d = static_cast<std::size_t>(seeds_.dimension);
  double farthest = -infinite, terms = 0, size = 0;
  for (std::uint32_t slot = mesh_.region_offset[region]; slot < mesh_.region_offset[region + 1]; ++slot) {
    const double* x = &mesh_.vertices[std::size_t{mesh_.region_vertex[slot]} * d];
    double along = 0, sum = 0;
    for (std::size_t k = 0; k < d; ++k) {
      const double part = direction[k] * (x[k] - seed_[k]);
      along += part;
      sum += std::abs(part);
    }
    farthest = std::max(farthest, along);
    terms = std::max(terms, sum);
  }
  for (std::size_t k = 0; k < d; ++k) size += std::abs(direction[k]);
  const double nearest = hull_->least_along(direction);
  // The rounding of the scalar products with the cell's vertices is far below the error of the vertices.
  return nearest - farthest > size * hull_->error + rounding * terms;
}

bool CellSearch::beyond_a_facet(std::uint32_t region) const {
  const auto d = static_cast<std::size_t>(seeds_.dimension);
  const std::uint32_t first = mesh_.region_offset[region], corners = mesh_.region_offset[region + 1] - first;
  const auto corner = [&](std::uint32_t k) {
    return &mesh_.vertices[std::size_t{mesh_.region_vertex[first + k]} * d];
  };
  if (d == 2 && mesh_.shape == RegionShape::polygon) {
    for (std::uint32_t k = 0; k < corners; ++k) {
      const double *a = corner(k), *b = corner(k + 1 == corners ? 0 : k + 1);
      const double outward[2] = {b[1] - a[1], a[0] - b[0]};
      if (separated_along(outward, region)) return true;
    }
  }
  if (mesh_.shape != RegionShape::tetrahedron) return false;
  for (const auto& facet : tetrahedron_facet) {
    const double* a = corner(facet[0]);
    const auto outward =
        cross(difference<double>(corner(facet[1]), a), difference<double>(corner(facet[2]), a));
    if (separated_along(outward.data(), region)) return true;
  }
  return false;
}

void CellSearch::visit_regions(std::size_t group, std::size_t members, std::size_t first, std::size_t last) {
  const Lanes* const box = blocks_.boxes(0, group);
  const std::uint64_t corner = blocks_.corner_offset[group];
  const std::size_t corners =
      (blocks_.corner_offset[group + 1] - corner) / static_cast<std::size_t>(seeds_.dimension);
  Lanes gap, beyond;
  blocks_.find_gaps(0, group, seed_, hull_->low.data(), hull_->high.data(), gap);
  if (std::all_of(gap.begin(), gap.end(), [](double g) { return g > 0; })) return;
  greatest_.resize(std::max(greatest_.size(), (last - first) * fan));
  loops::test_corners(&bisectors_[first], last - first, seeds_.dimension, box, &blocks_.corner[corner],
                      corners, seed_, beyond, greatest_.data());
  for (std::size_t lane = 0; lane < members; ++lane) {
    const std::uint32_t region = groups_.order[group * fan + lane];
    if (gap[lane] > 0 || beyond[lane] > 0) continue;
    if (hull_->empty() || !beyond_a_facet(region)) found_->push_back(region);
  }
}

void CellSearch::visit(std::size_t level, std::size_t group, std::size_t first, std::size_t last) {
  const std::size_t count = last - first;
  if (level == 0 || count == 0) return add_all(level, group);
  const std::size_t below = groups_.level[level - 1].low.size() / static_cast<std::size_t>(seeds_.dimension);
  const std::size_t members = std::min(fan, below - group * fan);
  if (level == 1) return visit_regions(group, members, first, last);
  Lanes gap, beyond;
  const Lanes* const box = blocks_.boxes(level - 1, group);
  blocks_.find_gaps(level - 1, group, seed_, hull_->low.data(), hull_->high.data(), gap);
  if (std::all_of(gap.begin(), gap.end(), [](double g) { return g > 0; })) return;
  greatest_.resize(std::max(greatest_.size(), count * fan));
  loops::test_boxes(&bisectors_[first], count, seeds_.dimension, box, seed_, beyond, greatest_.data());
  // The bisectors of all members are appended before the descent, which overwrites greatest_.
  std::array<std::size_t, fan + 1> end;
  end[0] = bisectors_.size();
  for (std::size_t lane = 0; lane < members; ++lane) {
    beyond[lane] = std::max(beyond[lane], gap[lane]);
    if (!(beyond[lane] > 0))
      for (std::size_t j = 0; j < count; ++j)
        if (!(greatest_[j * fan + lane] < 0)) {
          const loops::Bisector bisector = bisectors_[first + j];
          bisectors_.push_back(bisector);
        }
    end[lane + 1] = bisectors_.size();
  }
  for (std::size_t lane = 0; lane < members; ++lane)
    if (!(beyond[lane] > 0)) visit(level - 1, group * fan + lane, end[lane], end[lane + 1]);
  bisectors_.resize(end[0]);
}

namespace {

constexpr std::size_t task_size = 64;

struct Task {
  std::vector<std::uint32_t> regions;  // cell after cell
  std::vector<std::uint64_t> end;      // per cell
};

class Worker {
 public:
  explicit Worker(const CellSearchInput& search)
      : walls_(search.walls), cells_(search.mesh, search.groups, search.blocks, search.seeds, search.walls) {}

  void run(std::span<const std::uint32_t> ranks, Task& task) {
    for (const std::uint32_t rank : ranks) {
      hull_.set(walls_, rank);
      cells_.find(rank, hull_, task.regions);
      task.end.push_back(task.regions.size());
    }
  }

 private:
  const CellWalls& walls_;
  CellSearch cells_;
  CellHull hull_;
};

/// The pairs of all ranks in order: those found, and one with the container for each rank not searched.
Pairs gather(const CellSearchInput& search, const std::vector<Task>& tasks) {
  const auto around = static_cast<std::uint32_t>(search.mesh.region_count());
  const std::span<const std::uint32_t> ranks = search.ranks;
  std::uint64_t total = search.seeds.size() - ranks.size();
  for (const Task& task : tasks) total += task.regions.size();
  Pairs pairs;
  pairs.offset.reserve(search.seeds.size() + 1);
  pairs.region.reserve(total);
  const auto fill_up_to = [&](std::size_t rank) {
    for (; pairs.offset.size() < rank; pairs.region.push_back(around))
      pairs.offset.push_back(pairs.region.size());
  };
  for (std::size_t at = 0; at < ranks.size(); ++at) {
    fill_up_to(ranks[at]);
    pairs.offset.push_back(pairs.region.size());
    const Task& task = tasks[at / task_size];
    const std::size_t cell = at % task_size;
    const auto end = [&](std::size_t k) {
      return task.regions.begin() + static_cast<std::ptrdiff_t>(task.end[k]);
    };
    pairs.region.insert(pairs.region.end(), cell == 0 ? task.regions.begin() : end(cell - 1), end(cell));
  }
  fill_up_to(search.seeds.size());
  pairs.offset.push_back(pairs.region.size());
  return pairs;
}

}  // namespace

Pairs search_cells(const CellSearchInput& search) {
  const std::span<const std::uint32_t> ranks = search.ranks;
  std::vector<Task> tasks((ranks.size() + task_size - 1) / task_size);
  std::deque<Worker> workers;
  for (int w = 0; w < search.threads; ++w) workers.emplace_back(search);
  std::atomic<std::size_t> done{0};
  parallel_tasks(search.threads, tasks.size(), [&](int w, std::size_t t) {
    const std::size_t first = t * task_size;
    workers[static_cast<std::size_t>(w)].run(ranks.subspan(first, std::min(task_size, ranks.size() - first)),
                                             tasks[t]);
    const double share = static_cast<double>(++done) / static_cast<double>(tasks.size());
    // The callback runs on the calling thread only, which is worker 0.
    if (w == 0) report_progress(search.progress, share, 1);
  });
  return gather(search, tasks);
}

}  // namespace powercell::pairs
