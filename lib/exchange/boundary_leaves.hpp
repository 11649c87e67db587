/// \file
/// Estimates ghost seeds from positions: what is sent before any cell is clipped. It never affects results
/// (docs/scale.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "lib/exchange/cut_test.hpp"
#include "lib/exchange/messages.hpp"
#include "lib/exchange/other_shards.hpp"
#include "lib/exchange/translations.hpp"
#include "lib/exchange/tree_seeds.hpp"

namespace powercell::exchange {

/// The shards whose coarse trees are near seeds of this one, or heavy enough to matter to them. Each comes
/// with the part of this shard that is near. \param moves  translations() of this shard's seeds
std::map<int, NearPart> near_shards(const TreeSeeds& seeds, const OtherShards& others,
                                    const std::vector<Point>& moves);

/// The worst-case cell of a leaf: the largest reach and the smallest weight of its seeds, as far from the
/// origin as any of them.
/// \param box  of the leaf, as translated
/// \param reach  bounds the reach of each seed in the leaf
CutTest farthest_cell(const TreeSeeds& seeds, std::size_t leaf, const BoxView& box, double reach);

/// The boundary leaves: leaves of this shard's tree that are near boxes of the other's coarse tree, each
/// translated to there.
BoundaryLeaves find_boundary_leaves(const TreeSeeds& seeds, const PackedTree& other,
                                    const std::vector<Point>& moves);

/// Finds seeds near the boundary leaves of another shard. The memory is reused from leaf to leaf.
class NearBoundary {
 public:
  /// \param own  ranks of the asking shard's seeds, where `seeds` contains them
  explicit NearBoundary(const TreeSeeds& seeds, std::pair<std::size_t, std::size_t> own = {})
      : seeds_(seeds), tree_(seeds.tree), own_(own) {}

  /// Whether nearly all leaves of the other shard have likely neighbours here, judged by a few leaves. Nearly
  /// all seeds would then be sent.
  bool is_everywhere(const BoundaryLeaves& boundary);
  /// Appends the ranks of likely neighbours of the seeds of boundary leaf `k`.
  void find(const BoundaryLeaves& boundary, std::size_t k, std::vector<std::uint32_t>& ranks);

 private:
  using Distances = std::array<double, PackedTree::fan>;  // by seed of the boundary's leaf

  /// Lists leaves that may contain likely neighbours.
  /// \return whether there are few
  bool find_leaves(const BoundaryLeaves& boundary, std::size_t k, double far);
  /// Computes squared distances to all seeds of these leaves.
  /// \return the smallest for each seed of the boundary leaf
  Distances measure(const double* boundary_seeds);
  bool is_own(std::size_t rank) const { return own_.first <= rank && rank < own_.second; }

  TreeSeeds seeds_;
  const PackedTree& tree_;
  std::pair<std::size_t, std::size_t> own_;
  std::vector<std::uint32_t> leaves_;
  std::vector<Distances> distance2_;  // by seed in these leaves
};

}  // namespace powercell::exchange
