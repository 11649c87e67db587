/// \file
/// Voronoi treemaps: a weighted tree drawn as nested convex cells whose areas are proportional to the values.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <powercell/device.hpp>
#include <powercell/domain.hpp>
#include <span>
#include <string>
#include <vector>

namespace powercell {

/// A weighted tree of n nodes. A view: the caller owns the arrays and keeps them alive during the call.
struct TreeView {
  static constexpr std::int64_t no_parent = -1;
  std::span<const std::int64_t> parent;  ///< n: index of the parent; no_parent for the only root
  std::span<const double> value;         ///< n: values of the leaves, in any unit; ignored for other nodes
};

struct TreemapOptions {
  /// Limit on the relative error of any node's area, relative to its share of the outline.
  double tolerance = 1e-6;
  /// Limit on the iterations that move seeds to the centroids of their cells; more make rounder cells.
  int rounds = 25;
  /// Seed of the random initial positions. The same seed gives the same layout for any number of threads.
  std::uint64_t random_seed = 1;
  /// An earlier layout to stay close to: n x 2, as returned by relative_positions(); NaN for new nodes. Empty
  /// for a fresh layout.
  std::span<const double> start = {};

  /// Name of a node in error messages; "node 12" if not set.
  std::function<std::string(std::size_t)> name = {};

  int threads = 0;  ///< on the host; 0 means all
  /// Device for groups of more than `large_group` siblings. If empty, the first such group calls
  /// Device::choose().
  std::optional<Device> device = {};
  /// Groups up to this size are laid out on the host, where they take less time than launches on a device.
  std::size_t large_group = 4096;

  /// Called from time to time, by one thread at a time, with the fraction done in [0, 1]; returning false
  /// stops with Error interrupted.
  std::function<bool(double)> progress = {};
};

enum class TreeNode : std::uint8_t {
  leaf,
  group,    ///< has children with a value
  dropped,  ///< a leaf with a value of 0 or below, or a group without remaining children: has no polygon
};

/// A layout. Arrays are owned and indexed by node, as in the tree.
struct Treemap {
  std::vector<TreeNode> kind;                ///< n
  std::vector<double> value;                 ///< n: for a group the sum of its leaves; 0 if dropped
  std::vector<std::uint32_t> depth;          ///< n: 0 for the root
  std::vector<std::uint64_t> vertex_offset;  ///< n + 1: node i has [vertex_offset[i], vertex_offset[i+1])
  /// x, y pairs; each polygon is convex and counter-clockwise. A dropped node has none. Neither has a node
  /// thinner than the rounding of its corners, nor its descendants; its group is listed in not_converged.
  std::vector<double> vertices;
  std::vector<double> seeds;  ///< n x 2, near the centroids; NaN if dropped or without a polygon

  /// Largest |area / share of the outline - 1| over the leaves, and the leaf that has it, measured on the
  /// final polygons. It includes the rounding of corners to last places of the outline's size and
  /// coordinates, which may exceed the tolerance for a leaf that is tiny in comparison.
  double worst_error = 0;
  std::size_t worst_leaf = 0;
  /// Mean over the leaves with an area of the ratio of the longer to the shorter principal axis (of the
  /// second moments).
  double mean_aspect = 1;
  std::size_t leaves = 0;
  /// Groups whose areas did not reach the tolerance, ascending; they keep the best weights found.
  std::vector<std::size_t> not_converged;
  std::uint64_t diagrams = 0, newton_steps = 0;  ///< totals over all groups
};

/// Lays out a tree in a convex outline. An only child gets the polygon of its parent. Other siblings are the
/// cells of a power diagram whose seeds are near the centroids and whose weights are found by the damped
/// Newton method (Balzer, Deussen 2005; Nocaj, Brandes 2012; Kitagawa, Mérigot, Thibert 2019), so areas are
/// exact to `tolerance` for any values. The same input gives the same bits.
/// \param outline  convex, in either orientation
/// \throw Error invalid_argument (sizes; an option out of range; a parent out of range; no root or more than
///   one; a cycle; a value that is not finite, or too small a part of the sum: which node; no value above 0)
/// \throw Error invalid_domain (an outline that is not convex: where; one so thin or far from the origin that
///   rounding changes its area by a millionth)
/// \throw Error interrupted; as Diagram, if there is a large group
POWERCELL_API Treemap treemap(const TreeView& tree, const Ring& outline, const TreemapOptions& options = {});

/// Positions of the nodes in their parents, from which the layout of a changed tree can start
/// (TreemapOptions::start): the seed relative to the centroid of the parent, in units of the square root of
/// the parent's area. An unchanged tree gets the same layout: the seeds stay (measured for values over 14
/// orders of magnitude) and the polygons agree to the tolerance.
/// \param parent         n, as in TreeView
/// \param seeds          n x 2, as in Treemap; where NaN, the centroid of the node takes its place
/// \param vertex_offset  n + 1, as in Treemap; a node without a polygon has no vertices
/// \param vertices       x, y pairs, as in Treemap
/// \return n x 2; NaN where a node or its parent has no polygon
/// \throw Error invalid_argument (sizes that do not match; offsets that do not ascend)
POWERCELL_API std::vector<double> relative_positions(std::span<const std::int64_t> parent,
                                                     std::span<const double> seeds,
                                                     std::span<const std::uint64_t> vertex_offset,
                                                     std::span<const double> vertices);

}  // namespace powercell
