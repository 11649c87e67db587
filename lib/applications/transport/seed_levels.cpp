#include "lib/applications/transport/seed_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <span>

namespace powercell {
namespace {

constexpr std::size_t few_seeds = 150, seeds_per_cluster = 8;
constexpr double mass_power = 0.5;  // sizes of clusters lie between the numbers of their seeds and the masses

using Clusters = std::vector<std::vector<std::uint32_t>>;  // per cluster its seeds

struct Cluster {
  double size;
  std::vector<std::uint32_t> seeds;
  bool operator<(const Cluster& other) const { return size < other.size; }
};

std::size_t longest_side(const Cluster& cluster, std::span<const double> positions, std::size_t d) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t c = 0; c < d; ++c) {
    const auto [low, high] =
        std::ranges::minmax(cluster.seeds, {}, [&](std::uint32_t i) { return positions[i * d + c]; });
    const double side = positions[high * d + c] - positions[low * d + c];
    if (side <= length) continue;
    length = side;
    longest = c;
  }
  return longest;
}

/// Splits off the half with the larger coordinates.
Cluster split(Cluster& cluster, std::span<const double> positions, std::size_t d,
              std::span<const double> size) {
  const std::size_t axis = longest_side(cluster, positions, d);
  std::vector<std::uint32_t>& seeds = cluster.seeds;
  std::ranges::stable_sort(seeds, {}, [&](std::uint32_t i) { return positions[i * d + axis]; });
  std::size_t kept = 0;
  double below = 0;
  while (kept + 1 < seeds.size() && (kept == 0 || below + size[seeds[kept]] / 2 < cluster.size / 2))
    below += size[seeds[kept++]];
  Cluster rest{cluster.size - below, {seeds.begin() + static_cast<std::ptrdiff_t>(kept), seeds.end()}};
  seeds.resize(kept);
  cluster.size = below;
  return rest;
}

/// Divides seeds into at most `count` clusters of about equal sums of `size`, apart from seeds that are
/// larger alone: halves the largest across its longest side until there are as many.
Clusters cluster_seeds(std::span<const double> positions, std::size_t d, std::span<const double> size,
                       std::size_t count) {
  std::priority_queue<Cluster> open;
  Clusters result;
  Cluster all{std::accumulate(size.begin(), size.end(), 0.0), std::vector<std::uint32_t>(size.size())};
  std::iota(all.seeds.begin(), all.seeds.end(), 0U);
  open.push(std::move(all));
  while (!open.empty()) {
    Cluster largest = open.top();
    open.pop();
    if (largest.seeds.size() == 1 || result.size() + open.size() + 1 >= count) {
      result.push_back(std::move(largest.seeds));
      continue;
    }
    open.push(split(largest, positions, d, size));
    open.push(std::move(largest));
  }
  return result;
}

Weighted coarser(const Weighted& fine, std::size_t d, std::size_t count) {
  std::vector<double> size = fine.mass;
  const double largest = std::ranges::max(size);
  for (double& m : size) m = std::pow(m / largest, mass_power);
  const Clusters clusters = cluster_seeds(fine.positions, d, size, count);
  const std::size_t n = clusters.size();
  Weighted level{std::vector<double>(n * d), std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t k = 0; k < n; ++k) {
    double& mass = level.mass[k];
    for (const std::uint32_t i : clusters[k]) mass += fine.mass[i];
    for (const std::uint32_t i : clusters[k])
      for (std::size_t c = 0; c < d; ++c)
        level.positions[k * d + c] += fine.mass[i] / mass * fine.positions[i * d + c];
  }
  return level;
}

}  // namespace

std::vector<Weighted> seed_levels(Weighted seeds, std::size_t d) {
  std::vector<Weighted> levels{std::move(seeds)};
  while (levels.back().size() > few_seeds)
    levels.push_back(coarser(levels.back(), d, levels.back().size() / seeds_per_cluster));
  return levels;
}

}  // namespace powercell
