#include "lib/applications/transport/clusters.hpp"

#include <algorithm>
#include <numeric>
#include <queue>

namespace powercell {
namespace {

struct Cluster {
  double size;
  std::vector<std::uint32_t> seeds;
  bool operator<(const Cluster& other) const { return size < other.size; }
};

std::size_t longest_side(const Cluster& cluster, std::span<const double> positions, std::size_t d) {
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t c = 0; c < d; ++c) {
    const auto [low, high] = std::ranges::minmax(cluster.seeds, {}, [&](std::uint32_t i) { return positions[i * d + c]; });
    const double side = positions[high * d + c] - positions[low * d + c];
    if (side <= length) continue;
    length = side;
    longest = c;
  }
  return longest;
}

/// Splits off the half with the larger coordinates.
Cluster split(Cluster& cluster, std::span<const double> positions, std::size_t d, std::span<const double> size) {
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

}  // namespace

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

}  // namespace powercell
