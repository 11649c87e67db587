/// \file
/// A guess which seeds of a shard the cells at the rim of another need, from positions alone. It decides what
/// is sent before any cell is clipped, and no result (docs/scale.md). Internal.
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

/// The other shards that seeds of a shard are near, or that have seeds heavy enough to matter to them, as far
/// as the first outlines tell, each with the part that these seeds are in.
/// \param moves  of the shard's seeds (translations())
std::map<int, NearPart> near_shards(const TreeSeeds& seeds, const OtherShards& others,
                                    const std::vector<Point>& moves);

/// A cell that reaches as far as any of the seeds of a leaf, whose own reach is at most `reach`: of a seed as
/// light and as far from the origin as any. \param box  of the leaf, or where it is moved to
CutTest farthest_cell(const TreeSeeds& seeds, std::size_t leaf, const BoxView& box, double reach);

/// The leaves of a shard's tree that are near the boxes of another's outline, each moved to there.
Rim find_rim(const TreeSeeds& seeds, const PackedTree& other, const std::vector<Point>& moves);

/// Finds the seeds near leaves of another's rim. The memory is reused from leaf to leaf.
class NearRim {
 public:
  /// \param own  the ranks of the asking shard's seeds, if these are among the others
  explicit NearRim(const TreeSeeds& seeds, std::pair<std::size_t, std::size_t> own = {})
      : seeds_(seeds), tree_(seeds.tree), own_(own) {}

  /// Whether nearly all leaves of the other shard have likely neighbours here. Then the two have no rim
  /// between them, and nearly all seeds would be sent. Tells by some leaves.
  bool is_everywhere(const Rim& rim);
  /// Appends the ranks of the seeds that are likely neighbours of those of leaf `k` of the rim.
  void find(const Rim& rim, std::size_t k, std::vector<std::uint32_t>& ranks);

 private:
  using Row = std::array<double, PackedTree::fan>;  // by seed of the rim's leaf

  /// Lists the leaves that may have likely neighbours. \return whether they are few
  bool find_leaves(const Rim& rim, std::size_t k, double far);
  /// Sets the squared distances of all seeds in them. \return the least of each seed of the rim's leaf
  Row measure(const double* rim_seeds);
  bool is_own(std::size_t rank) const { return own_.first <= rank && rank < own_.second; }

  TreeSeeds seeds_;
  const PackedTree& tree_;
  std::pair<std::size_t, std::size_t> own_;
  std::vector<std::uint32_t> leaves_;
  std::vector<Row> distance2_;  // by seed in these leaves
};

}  // namespace powercell::exchange
