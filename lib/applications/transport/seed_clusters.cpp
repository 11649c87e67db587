#include "lib/applications/transport/seed_clusters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace powercell {
namespace {

// A cluster is this many times as small as what it is apart from, and as the cluster around it.
constexpr double apart = 30, smaller = 30;

}  // namespace

SeedClusters::SeedClusters(std::span<const double> positions, const Vector& mass, std::size_t d)
    : positions_(positions), mass_(mass), d_(d), seeds_(positions.size() / d) {
  std::iota(seeds_.begin(), seeds_.end(), 0U);
  nodes_.push_back({0, static_cast<std::uint32_t>(seeds_.size()), none});
  set_box(0);
  for (std::uint32_t node = 0; node < nodes_.size(); ++node)
    if (nodes_[node].last - nodes_[node].first > 1) split(node);
}

void SeedClusters::set_box(std::uint32_t node) {
  for (std::size_t c = 0; c < d_; ++c) {
    double low = positions_[seeds_[nodes_[node].first] * d_ + c], high = low;
    for (std::uint32_t k = nodes_[node].first; k < nodes_[node].last; ++k) {
      const double x = positions_[seeds_[k] * d_ + c];
      low = std::min(low, x);
      high = std::max(high, x);
    }
    low_.push_back(low);
    high_.push_back(high);
  }
}

/// Halves the longest side of the box.
void SeedClusters::split(std::uint32_t node) {
  std::size_t axis = 0;
  for (std::size_t c = 1; c < d_; ++c)
    if (high_[node * d_ + c] - low_[node * d_ + c] > high_[node * d_ + axis] - low_[node * d_ + axis])
      axis = c;
  const double middle = low_[node * d_ + axis] / 2 + high_[node * d_ + axis] / 2;
  const auto begin = seeds_.begin() + nodes_[node].first, end = seeds_.begin() + nodes_[node].last;
  auto upper =
      std::partition(begin, end, [&](std::uint32_t seed) { return positions_[seed * d_ + axis] <= middle; });
  if (upper == begin || upper == end) upper = begin + (end - begin) / 2;  // sides that rounding makes 0
  const auto cut = static_cast<std::uint32_t>(upper - seeds_.begin());
  nodes_[node].below = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({nodes_[node].first, cut, node});
  set_box(nodes_[node].below);
  nodes_.push_back({cut, nodes_[node].last, node});
  set_box(nodes_[node].below + 1);
}

double SeedClusters::diameter(std::uint32_t node) const {
  double square = 0;
  for (std::size_t c = 0; c < d_; ++c) square += std::pow(high_[node * d_ + c] - low_[node * d_ + c], 2);
  return std::sqrt(square);
}

double SeedClusters::distance(std::uint32_t a, std::uint32_t b) const {
  double square = 0;
  for (std::size_t c = 0; c < d_; ++c) {
    const std::size_t i = a * d_ + c, j = b * d_ + c;
    square += std::pow(std::max({low_[i] - high_[j], low_[j] - high_[i], 0.0}), 2);
  }
  return std::sqrt(square);
}

/// \param around  the diameter of the cluster that the node is in
bool SeedClusters::is_cluster(std::uint32_t node, double around) const {
  const double size = diameter(node);
  if (smaller * size > around) return false;
  // All other seeds are in the siblings of the node and of those above it.
  for (std::uint32_t at = node; nodes_[at].above != none; at = nodes_[at].above) {
    const std::uint32_t first = nodes_[nodes_[at].above].below;
    if (apart * size > distance(node, at == first ? first + 1 : first)) return false;
  }
  return true;
}

void SeedClusters::add(std::uint32_t node, std::uint32_t parent, SeedLevel& level) const {
  double mass = 0;
  std::vector<double> off(d_);  // from the corner of the box, as clusters may be small beside coordinates
  for (std::uint32_t k = nodes_[node].first; k < nodes_[node].last; ++k) {
    const double m = mass_[static_cast<Eigen::Index>(seeds_[k])];
    mass += m;
    for (std::size_t c = 0; c < d_; ++c) off[c] += m * (positions_[seeds_[k] * d_ + c] - low_[node * d_ + c]);
  }
  for (std::size_t c = 0; c < d_; ++c) level.positions.push_back(low_[node * d_ + c] + off[c] / mass);
  level.mass.push_back(mass);
  level.node.push_back(node);
  level.parent.push_back(parent);
}

SeedLevel SeedClusters::root() const {
  SeedLevel result;
  add(0, 0, result);
  return result;
}

SeedLevel SeedClusters::finer(const SeedLevel& level) const {
  SeedLevel result;
  std::vector<std::uint32_t> open;
  for (std::uint32_t parent = 0; parent < level.size(); ++parent) {
    const std::uint32_t whole = level.node[parent];
    if (nodes_[whole].below == none) {
      add(whole, parent, result);
      continue;
    }
    const double around = diameter(whole);
    open = {nodes_[whole].below, nodes_[whole].below + 1};
    while (!open.empty()) {
      const std::uint32_t node = open.back();
      open.pop_back();
      if (nodes_[node].below == none || is_cluster(node, around)) {
        add(node, parent, result);
      } else {
        open.push_back(nodes_[node].below);
        open.push_back(nodes_[node].below + 1);
      }
    }
  }
  return result;
}

}  // namespace powercell
