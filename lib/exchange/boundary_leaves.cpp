#include "lib/exchange/boundary_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/base/vector_copies.hpp"
#include "lib/exchange/boxes.hpp"
#include "lib/exchange/tree_walk.hpp"

namespace powercell::exchange {
namespace {

/// Two seeds are likely neighbours up to `depth` times the spacing of those of the asked shard. So are the
/// nearest seed and those up to `layer` spacings farther, if it is at most `farthest` times the spacing of
/// the asking shard's seeds away (docs/scale.md, "The estimate").
constexpr double depth = 1.8, layer = 0.5, farthest = 1.5;
/// The box of the few seeds of a leaf is now and then much smaller than their spacing.
constexpr double leaf_trust = 1.5;
/// A leaf of a boundary that spans more leaves is among denser seeds, of which it needs few.
constexpr std::size_t most_leaves = 512;
/// The part of a shard's leaves that counts as all, and of how many of them one is looked at.
constexpr double nearly_all = 0.9;
constexpr std::size_t sample = 16;

/// How far apart the seeds below nodes of a tree are, about.
class Spacing {
 public:
  explicit Spacing(const PackedTree& tree)
      : tree_(tree),
        leaf_edge_(tree.dimension == 2 ? std::sqrt(8.0) : 2),
        wide_edge_(leaf_edge_ * leaf_edge_) {}

  /// Of the seeds of a leaf, or at least that of all leaves below another node.
  double operator()(std::uint32_t number) const {
    if (number >= tree_.level_offset[1]) return edge(number) / wide_edge_;
    const double own = edge(number) / leaf_edge_;
    if (tree_.levels() == 1) return own;
    const double wide = edge(tree_.level_offset[1] + number / PackedTree::fan) / wide_edge_;
    return own > 0 ? std::min(wide, leaf_trust * own) : wide;
  }

 private:
  /// The mean edge of a node's box.
  double edge(std::uint32_t number) const {
    const auto d = static_cast<std::size_t>(tree_.dimension);
    const double sum =
        sum_along(d, [&](std::size_t k) { return tree_.high[number * d + k] - tree_.low[number * d + k]; });
    return sum / static_cast<double>(d);
  }

  const PackedTree& tree_;
  double leaf_edge_, wide_edge_;  // of boxes of 8 and 64 seeds, in units of their spacing
};

/// The least weight of the seeds of a leaf.
double lightest_of(const TreeSeeds& seeds, std::size_t leaf) {
  const auto at = [&](std::size_t k) {
    return seeds.weights.begin() + static_cast<std::ptrdiff_t>(seeds.first_of(k));
  };
  return *std::min_element(at(leaf), at(leaf + 1));
}

}  // namespace

CutTest farthest_cell(const TreeSeeds& seeds, std::size_t leaf, const BoxView& box, double reach) {
  const std::size_t d = seeds.dimension();
  std::array<double, 4> farthest{};
  for (std::size_t k = 0; k < d; ++k) farthest[k] = std::max(std::abs(box.low[k]), std::abs(box.high[k]));
  farthest[d] = lightest_of(seeds, leaf);
  return {farthest.data(), reach, seeds.tree.dimension};
}

std::map<int, NearPart> near_shards(const TreeSeeds& seeds, const OtherShards& others,
                                    const std::vector<Point>& moves) {
  const PackedTree& tree = seeds.tree;
  std::map<int, NearPart> parts;
  if (tree.levels() == 0) return parts;
  const std::size_t d = seeds.dimension();
  const Spacing spacing(tree);
  const auto look_at = [&](std::uint32_t leaf, const BoxView& box) {
    // Of seeds as light as the lightest one, those up to `farthest` spacings away may meet such a cell (39b).
    const CutTest cell =
        farthest_cell(seeds, leaf, box, std::max(farthest / 2 * spacing(leaf), least_radius));
    const auto is_near = [&](const PackedTree& boxes, std::uint32_t node) {
      return cell.may_meet(gap2(box, box_of(boxes, node), d), boxes.weight[node]);
    };
    others.visit(is_near, [&](int shard) {
      const double lightest = lightest_of(seeds, leaf);
      const auto [part, is_new] = parts.try_emplace(shard, NearPart{{}, lightest});
      if (is_new) part->second.box = box_around(box.low, 1, d);
      extend(part->second.box, box, d);
      part->second.lightest = std::min(part->second.lightest, lightest);
      return true;
    });
  };
  for (std::uint32_t leaf = 0; leaf < tree.level_offset[1]; ++leaf)
    for (const Point& move : moves) look_at(leaf, moved(box_of(tree, leaf), move, d).view());
  return parts;
}

BoundaryLeaves find_boundary_leaves(const TreeSeeds& seeds, const PackedTree& other,
                                    const std::vector<Point>& moves) {
  const PackedTree& tree = seeds.tree;
  BoundaryLeaves boundary;
  if (tree.levels() == 0) return boundary;
  const std::size_t d = seeds.dimension();
  const Spacing spacing(tree);
  boundary.all = tree.level_offset[1];
  boundary.lightest = std::numeric_limits<double>::infinity();
  for (const Point& move : moves) {
    const auto is_near = [&](std::uint32_t node) {
      const Box box = moved(box_of(tree, node), move, d);
      const double limit = farthest * spacing(node);
      return has_open_leaf(
          other, [&](std::uint32_t b) { return gap2(box.view(), box_of(other, b), d) <= limit * limit; });
    };
    visit_leaves(tree, is_near, [&](std::uint32_t leaf) {
      boundary.lightest = std::min(boundary.lightest, lightest_of(seeds, leaf));
      boundary.spacing.push_back(spacing(leaf));
      for (std::uint32_t k = 0; k < PackedTree::fan; ++k) {
        const std::size_t rank = std::min<std::size_t>(leaf * PackedTree::fan + k, seeds.size() - 1);
        for (std::size_t c = 0; c < d; ++c) boundary.seed.push_back(seeds.position(rank)[c] + move[c]);
      }
      return true;
    });
  }
  return boundary;
}

bool NearBoundary::is_everywhere(const BoundaryLeaves& boundary) {
  if (static_cast<double>(boundary.leaves()) <= nearly_all * static_cast<double>(boundary.all)) return false;
  std::size_t asked = 0, near = 0;
  std::vector<std::uint32_t> ranks;
  for (std::size_t k = 0; k < boundary.leaves(); k += sample) {
    ranks.clear();
    find(boundary, k, ranks);
    ++asked;
    near += !ranks.empty();
  }
  return static_cast<double>(near) > nearly_all * static_cast<double>(asked);
}

bool NearBoundary::find_leaves(const BoundaryLeaves& boundary, std::size_t k, double far) {
  const std::size_t d = seeds_.dimension();
  const Box around = box_around(&boundary.seed[k * PackedTree::fan * d], PackedTree::fan, d);
  const Spacing spacing(tree_);
  leaves_.clear();
  const auto is_near = [&](std::uint32_t node) {
    const double h = spacing(node), most = std::max(depth * h, far + layer * h);
    if (gap2(around.view(), box_of(tree_, node), d) > most * most) return false;
    if (own_.second == 0) return true;
    const auto [first, last] = seeds_.ranks_of(node);
    return first < own_.first || own_.second < last;
  };
  visit_leaves(tree_, is_near, [&](std::uint32_t leaf) {
    leaves_.push_back(leaf);
    return leaves_.size() <= most_leaves;
  });
  return leaves_.size() <= most_leaves;
}

POWERCELL_VECTOR_COPIES
NearBoundary::Distances NearBoundary::measure(const double* boundary_seeds) {
  const std::size_t d = seeds_.dimension();
  std::array<Distances, 3> boundary;  // by axis, so that the loops below are over vectors
  for (std::size_t k = 0; k < d; ++k)
    for (std::size_t a = 0; a < PackedTree::fan; ++a) boundary[k][a] = boundary_seeds[a * d + k];
  Distances least;
  least.fill(std::numeric_limits<double>::infinity());
  distance2_.clear();
  for (const std::uint32_t leaf : leaves_)
    for (std::size_t rank = seeds_.first_of(leaf); rank < seeds_.first_of(leaf + std::size_t{1}); ++rank) {
      Distances row{};
      if (is_own(rank)) {
        row.fill(std::numeric_limits<double>::infinity());
      } else {
        for (std::size_t k = 0; k < d; ++k)
          for (std::size_t a = 0; a < row.size(); ++a) {
            const double gap = seeds_.positions[rank * d + k] - boundary[k][a];
            row[a] += gap * gap;
          }
        for (std::size_t a = 0; a < row.size(); ++a) least[a] = std::min(least[a], row[a]);
      }
      distance2_.push_back(row);
    }
  return least;
}

void NearBoundary::find(const BoundaryLeaves& boundary, std::size_t k, std::vector<std::uint32_t>& ranks) {
  const std::size_t d = seeds_.dimension();
  const double far = farthest * boundary.spacing[k];
  if (!find_leaves(boundary, k, far)) return;
  Distances nearest = measure(&boundary.seed[k * PackedTree::fan * d]);
  for (double& distance : nearest) distance = std::sqrt(distance);
  const Spacing spacing(tree_);
  std::size_t at = 0;
  for (const std::uint32_t leaf : leaves_) {
    const double h = spacing(leaf);
    Distances limit2;
    for (std::size_t a = 0; a < limit2.size(); ++a) {
      const double limit = std::max(depth * h, nearest[a] + layer * h);
      limit2[a] = nearest[a] <= far ? limit * limit : -1;
    }
    for (std::size_t rank = seeds_.first_of(leaf); rank < seeds_.first_of(leaf + std::size_t{1});
         ++rank, ++at) {
      unsigned likely = 0;  // without branches
      for (std::size_t a = 0; a < limit2.size(); ++a) likely |= distance2_[at][a] <= limit2[a] ? 1 : 0;
      if (likely != 0) ranks.push_back(static_cast<std::uint32_t>(rank));
    }
  }
}

}  // namespace powercell::exchange
