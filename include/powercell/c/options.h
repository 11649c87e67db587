/** \file
 * Options of a diagram; the defaults suit most callers.
 */
#ifndef POWERCELL_C_OPTIONS_H
#define POWERCELL_C_OPTIONS_H

#include <powercell/c/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum pc_precision {
  PC_PRECISION_AUTOMATIC = 0, /**< double where the device has it, else float */
  PC_FLOAT64,
  PC_FLOAT32
} pc_precision;

/** Where candidate neighbours come from. The cells are the same. */
typedef enum pc_neighbors {
  PC_NEIGHBORS_AUTOMATIC = 0, /**< the tree */
  PC_TREE,                    /**< a packed tree with largest weights, searched in the kernel */
  PC_FLANN /**< the paper's method: nearest lifted neighbours, from a KD-tree on the host */
} pc_neighbors;

/** How to treat cells whose shape rounding may have decided (powercell::Decisions). */
typedef enum pc_decisions {
  PC_DECISIONS_EXACT = 0, /**< decide again on the host with exact numbers */
  PC_DECISIONS_FAST       /**< keep them, and count them (pc_timings) */
} pc_decisions;

/** Options of a diagram. Fill with pc_options_init() first. */
typedef struct pc_options {
  size_t struct_size; /**< set by pc_options_init() */
  pc_precision precision;
  pc_neighbors neighbors;
  pc_decisions decisions;
  int certify;           /**< not 0: check each result by laws; PC_INTERNAL if one does not hold */
  int threads;           /**< host threads; 0 means all */
  int initial_neighbors; /**< FLANN only: 0 means 16, or 32 in volumes */
  int twin_queries;      /**< FLANN only: query with the twin (p_i, -h_i), not the lifted seed; default 1 */
  double lift_eta;       /**< FLANN only: the height eta of the lift; NaN, the default: the largest weight */
  uint64_t chunk_pairs; /**< the most (region, seed) pairs on the device at once; 0 lets the library choose */
  pc_progress progress; /**< may be NULL */
  void* progress_user;  /**< passed to progress */
} pc_options;

/** Sets every option to its default. \param struct_size  sizeof(pc_options) */
POWERCELL_API pc_status pc_options_init(pc_options* options, size_t struct_size);

#ifdef __cplusplus
}
#endif
#endif
