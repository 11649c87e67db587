/* Packs the tree by blocks (kernels/neighbors/blocks.cl) and lists the near leaves of each leaf. */
#include "neighbors/near.cl"

/* Work-item t packs leaf t, and as node t of `nodes` above the leaves its children. */
__kernel void pack_blocks(const uint leaves, const uint nodes, __global const seed_t* seeds,
                          const uint seed_count, __global const seed_t* node_low,
                          __global const seed_t* node_high, __global const uint* level_offset,
                          const int levels, __global stored_real* seed_block,
                          __global stored_real* node_block) {
  const uint t = (uint)get_global_id(0);
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, seed_count};
  if (t < leaves) pack_seed_block(tree, t, seed_block);
  if (t >= nodes) return;
  int level = 1;
  while (level_offset[level + 1] - leaves <= t) ++level;
  pack_node_block(tree, t - (level_offset[level] - leaves), level, node_block);
}

/* Work-item t lists the near leaves of leaf t, (10a). */
__kernel void list_near(const uint leaves, __global const seed_t* seeds, const uint seed_count,
                        __global const seed_t* node_low, __global const seed_t* node_high,
                        __global const uint* level_offset, const int levels,
                        __global const stored_real* seed_block, __global const stored_real* node_block,
                        __global uint* near, __global uint* near_count, __global stored_real* near_bound) {
  const uint t = (uint)get_global_id(0);
  if (t >= leaves) return;
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, seed_count};
  const blocks_t blocks = {seed_block, node_block, near, near_count, near_bound};
  real bound;
  near_count[t] = find_near(tree, blocks, t, near + (size_t)t * NEAR_MOST, &bound);
  near_bound[t] = bound;
}
