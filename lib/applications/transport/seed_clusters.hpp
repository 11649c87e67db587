/// \file
/// Clusters of seeds that are small beside their distances from all others.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lib/applications/linear/laplacian.hpp"

namespace powercell {

/// Seeds and clusters of seeds. A cluster stands at the mean of its seeds and has the sum of their masses.
struct SeedLevel {
  std::vector<double> positions;      ///< n x d
  std::vector<double> mass;           ///< n
  std::vector<std::uint32_t> node;    ///< n; see SeedClusters
  std::vector<std::uint32_t> parent;  ///< n; the cluster of the coarser level that it is a part of
  std::size_t size() const { return node.size(); }
};

/// A tree of boxes in which some nodes are clusters: 30 times as small as the cluster around them, and as
/// their distance from any other seed.
///
///     root() ─┬─ seed
///             ├─ cluster ─┬─ seed         finer(): the parts of each cluster instead of it
///             │           └─ cluster …
///             └─ seed
class SeedClusters {
 public:
  /// \param positions  n x d, no two the same; kept by reference
  /// \param mass       n, positive; kept by reference
  SeedClusters(std::span<const double> positions, const Vector& mass, std::size_t d);

  /// All as one cluster.
  SeedLevel root() const;
  SeedLevel finer(const SeedLevel& level) const;
  /// Whether a level has each seed by itself.
  bool is_finest(const SeedLevel& level) const { return level.size() == seeds_.size(); }
  /// The seed of a node of the finest level.
  std::uint32_t seed(std::uint32_t node) const { return seeds_[nodes_[node].first]; }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  struct Node {
    std::uint32_t first, last;  ///< [first, last) of seeds_
    std::uint32_t above;
    std::uint32_t below = none;  ///< the first of two children, which are neighbours; none for a seed
  };

  void split(std::uint32_t node);
  void set_box(std::uint32_t node);
  double diameter(std::uint32_t node) const;
  double distance(std::uint32_t a, std::uint32_t b) const;
  bool is_cluster(std::uint32_t node, double around) const;
  void add(std::uint32_t node, std::uint32_t parent, SeedLevel& level) const;

  std::span<const double> positions_;
  const Vector& mass_;
  std::size_t d_;
  std::vector<std::uint32_t> seeds_;
  std::vector<Node> nodes_;
  std::vector<double> low_, high_;  // of the nodes' boxes, d each
};

}  // namespace powercell
