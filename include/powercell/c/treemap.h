/** \file
 * Voronoi treemaps: a weighted tree drawn as nested convex cells whose areas are proportional to the values.
 */
#ifndef POWERCELL_C_TREEMAP_H
#define POWERCELL_C_TREEMAP_H

#include <powercell/c/device.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PC_NO_PARENT ((int64_t)-1) /**< the parent of the root */

typedef enum pc_tree_node {
  PC_NODE_LEAF = 0,
  PC_NODE_GROUP,  /**< has children with a value */
  PC_NODE_DROPPED /**< a leaf with a value of 0 or below, or a group without remaining children: has no
                     polygon */
} pc_tree_node;

/** Options of a treemap. Fill with pc_treemap_options_init() first. */
typedef struct pc_treemap_options {
  size_t struct_size;   /**< set by pc_treemap_options_init() */
  double tolerance;     /**< limit on the relative error of any node's area; default 1e-6 */
  int rounds;           /**< limit on the iterations that move seeds to centroids; default 25 */
  int threads;          /**< on the host; 0 means all */
  uint64_t random_seed; /**< of the initial positions; default 1 */
  const double*
      start; /**< count x 2, of pc_treemap_relative_positions(), NaN for new nodes; NULL for a fresh layout */
  const char* const* names; /**< count names for messages; NULL for "node 12" */
  const pc_device* device;  /**< for large groups; NULL for the default one, opened when it is needed */
  size_t large_group;       /**< groups up to this size are laid out on the host; default 4096 */
  pc_progress progress;     /**< may be NULL */
  void* progress_user;      /**< passed to progress */
} pc_treemap_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_treemap_options) */
POWERCELL_API pc_status pc_treemap_options_init(pc_treemap_options* options, size_t struct_size);

/** A layout; arrays are indexed by node, as in the tree of n nodes. */
typedef struct pc_treemap {
  size_t count;                  /**< n */
  const uint8_t* kind;           /**< n: a pc_tree_node each */
  const double* value;           /**< n: for a group the sum of its leaves; 0 if dropped */
  const uint32_t* depth;         /**< n: 0 for the root */
  const uint64_t* vertex_offset; /**< n + 1: node i has [vertex_offset[i], vertex_offset[i+1]) */
  const double* vertices;        /**< x, y pairs; each polygon is convex and counter-clockwise */
  const double* seeds;           /**< n x 2, near the centroids; NaN if dropped or without a polygon */
  double worst_error;            /**< largest |area / share of the outline - 1| over the leaves */
  size_t worst_leaf;             /**< the leaf that has it */
  double mean_aspect;            /**< mean over the leaves of the ratio of their principal axes */
  size_t leaves;
  size_t not_converged_count;
  const size_t* not_converged;     /**< groups whose areas did not reach the tolerance, ascending */
  uint64_t diagrams, newton_steps; /**< totals over all groups */
} pc_treemap;

/** Lays out a tree in a convex outline.
 * \param parent         count: index of the parent; PC_NO_PARENT for the only root
 * \param value          count: values of the leaves, in any unit; ignored for other nodes
 * \param outline        outline_count x 2, row-major, convex, in either orientation
 * \param options        NULL for the defaults */
POWERCELL_API pc_status pc_treemap_create(const int64_t* parent, const double* value, size_t count,
                                          const double* outline, size_t outline_count,
                                          const pc_treemap_options* options, const pc_treemap** treemap);
POWERCELL_API void pc_treemap_destroy(const pc_treemap* treemap);

/** Positions of the nodes in their parents, from which the layout of a changed tree can start (`start`).
 * \param parent     count
 * \param seeds      count x 2, as in pc_treemap
 * \param vertex_offset  count + 1, as in pc_treemap
 * \param vertices   as in pc_treemap
 * \param positions  count x 2; NaN where a node or its parent has no polygon */
POWERCELL_API pc_status pc_treemap_relative_positions(const int64_t* parent, const double* seeds,
                                                      size_t count, const uint64_t* vertex_offset,
                                                      const double* vertices, double* positions);

#ifdef __cplusplus
}
#endif
#endif
