/// \file
/// Voronoi treemaps: a weighted tree as nested convex cells whose areas are the values.
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

/// A weighted tree of n nodes; the caller owns the arrays for the length of the call.
struct TreeView {
  static constexpr std::int64_t no_parent = -1;
  std::span<const std::int64_t> parent;  ///< n: index of the parent, no_parent for the one root
  std::span<const double> value;         ///< n: of a leaf its value, any unit; of other nodes not looked at
};

struct TreemapOptions {
  /// Largest relative error allowed of the area of any node, against its share of the outline.
  double tolerance = 1e-6;
  /// How often at most seeds move to the centroids of their cells, areas kept; more makes rounder cells.
  int rounds = 25;
  /// Where the seeds start is random; the same number gives the same layout, whatever the threads.
  std::uint64_t random_seed = 1;
  /// An earlier layout to stay close to: n x 2 as `relative_positions` gives them, NaN for a node that was
  /// not in it. Empty: none.
  std::span<const double> start = {};

  /// How messages call a node, by its index; "node 12" if not set.
  std::function<std::string(std::size_t)> name = {};

  int threads = 0;  ///< on the host; 0 means all
  /// For groups of more than `large_group` siblings; without one `Device::choose()` is asked when the first
  /// such group comes.
  std::optional<Device> device = {};
  std::size_t large_group = 4096;

  /// Called from time to time, from one thread at a time, with the fraction done in [0, 1]; returning false
  /// stops with Error interrupted.
  std::function<bool(double)> progress = {};
};

enum class TreeNode : std::uint8_t {
  leaf,
  group,    ///< has children with a value
  dropped,  ///< value 0 or negative, or a group in which no child is left: no polygon
};

/// A layout. All arrays are owned by the struct and go by node, as in the tree.
struct Treemap {
  std::vector<TreeNode> kind;                ///< n
  std::vector<double> value;                 ///< n: of a group the sum of its leaves; 0 where dropped
  std::vector<std::uint32_t> depth;          ///< n: 0 for the root
  std::vector<std::uint64_t> vertex_offset;  ///< n + 1; node i has [vertex_offset[i], vertex_offset[i+1])
  /// x, y pairs; each polygon convex and counter-clockwise. Dropped nodes have none, nor have nodes thinner
  /// than the rounding of their corners and what is below them; their groups are in not_converged.
  std::vector<double> vertices;
  std::vector<double> seeds;  ///< n x 2, near the centroids; NaN where dropped or without a place

  /// Largest |area / its share of the outline - 1| of a leaf, and whose: measured on the polygons as they
  /// are. Rounding of corners is part of it, to last places of the outline's size and coordinates; where a
  /// leaf is tiny beside those that may be more than the tolerance.
  double worst_error = 0;
  std::size_t worst_leaf = 0;
  /// Mean over the leaves that have an area of the ratio of the longer to the shorter principal axis (of
  /// second moments).
  double mean_aspect = 1;
  std::size_t leaves = 0;
  /// Groups whose areas did not come within the tolerance; the best weights found were kept.
  std::vector<std::size_t> not_converged;
  std::uint64_t diagrams = 0, newton_steps = 0;  ///< computed in all groups together
};

/// Lays a tree out in a convex outline. A group with one child hands it its polygon. Within a group the
/// children are the cells of a power diagram whose seeds are near the centroids and whose weights are found
/// by the damped Newton method (Balzer, Deussen 2005; Nocaj, Brandes 2012; Kitagawa, Merigot, Thibert 2019),
/// so the areas are exact to `tolerance` for any values. Same input, same bits.
/// \param outline  convex, in either orientation
/// \throw Error invalid_argument (sizes; a parent out of range; no root or two; a cycle; a value that is not
///   finite: which node; nothing left to lay out), invalid_domain (an outline that is not convex: where; one
///   so thin or far off that rounding moves its area by a millionth), interrupted; as Diagram, with a large
///   group
POWERCELL_API Treemap treemap(const TreeView& tree, const Ring& outline, const TreemapOptions& options = {});

/// Where each node lies in its parent, in a form that a later, changed layout can start from: its seed, from
/// the centroid of the parent, in units of the square root of the parent's area. An unchanged tree gets the
/// same layout: seeds stay (measured for values over 14 orders of magnitude), polygons are the same to the
/// tolerance.
/// \param seeds  as in Treemap; the centroid stands in where there are none (NaN)
/// \param vertex_offset, vertices  polygons of nodes as in Treemap; an empty one for a node without
/// \return n x 2; NaN where a node or its parent has no polygon
/// \throw Error invalid_argument for sizes that do not match, offsets that do not ascend
POWERCELL_API std::vector<double> relative_positions(std::span<const std::int64_t> parent,
                                                     std::span<const double> seeds,
                                                     std::span<const std::uint64_t> vertex_offset,
                                                     std::span<const double> vertices);

}  // namespace powercell
