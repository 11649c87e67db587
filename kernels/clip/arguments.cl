/* The arguments that all clip kernels share, and the structs made from them. */
#ifndef POWERCELL_CLIP_ARGUMENTS
#define POWERCELL_CLIP_ARGUMENTS
#include "clip/write.cl"

/* Of all kernels that clip rows of pairs. Work-item t takes pair active[t] of the chunk and row t of the
   outputs, of which `outputs` (a sum of OUTPUT_...) are written; moments go by pair. */
#define PIECE_ARGUMENTS                                                                                     \
  const uint count, const uint outputs, __global const uint *active, __global const uint *pair_seed,        \
      __global const uint *pair_region, __global const seed_t *corners, __global const uint *region_offset, \
      __global const uint *region_vertex, __global const int *behind, __global const region_shape_t *shape, \
      __global uint *status, __global stored_real *moments, __global uint *faces, __global int *border,     \
      __global stored_real *wall, __global uint *vertices, __global stored_real *vertex,                    \
      __global uint *link, __global stored_real *reach
#define REGIONS_OF_ARGUMENTS \
  { corners, region_offset, region_vertex, behind, shape }
#define OUTPUT_OF_ARGUMENTS \
  { outputs, moments, faces, border, wall, vertices, vertex, link, reach }

/* Of the kernels that search the packed tree (TreeBlocks::append_arguments). */
#define TREE_ARGUMENTS                                                                       \
  __global const seed_t *seeds, const uint seed_count, __global const seed_t *node_low,      \
      __global const seed_t *node_high, __global const uint *level_offset, const int levels, \
      __global const stored_real *seed_block, __global const stored_real *node_block,        \
      __global const uint *near, __global const uint *near_count, __global const stored_real *near_bound
#define TREE_OF_ARGUMENTS \
  { seeds, node_low, node_high, level_offset, levels, seed_count }
#define BLOCKS_OF_ARGUMENTS \
  { seed_block, node_block, near, near_count, near_bound }

#endif
