/* Finds the leaves nearest to a leaf by lifted distance, in which heavy leaves count as nearer. */
#ifndef POWERCELL_NEIGHBORS_NEAREST
#define POWERCELL_NEIGHBORS_NEAREST
#include "neighbors/near.cl"

/* Writes the lifted distances of a node's children from the home; returns a bit for each below `reach`. */
static inline uint children_within(tree_t tree, blocks_t blocks, const home_t* home, uint node, int level,
                                   real reach, real* distance) {
  uint bits = 0;
  EACH_LANE(lane) {
    reals a[DIMENSION], b[DIMENSION], dw;
    node_lanes(blocks, block_of_children(tree, node, level), lane, &home->origin, a, b, &dw);
    const reals lifted = lifted_distances(home, a, b, dw);
    store_lanes(lifted, distance + lane);
    bits |= lane_bits(lifted < all_lanes(reach)) << lane;
  }
  const uint children = children_end(tree, node, level - 1) - node * TREE_FAN;
  return bits & ((1u << children) - 1);
}

/* Inserts the leaves below a node that are nearer than the farthest one kept. */
static inline void take_leaves(nearest_t* near, tree_t tree, blocks_t blocks, const home_t* home, uint node) {
  real distance[LANES] FOR_LANES;
  uint bits = children_within(tree, blocks, home, node, 1, nearest_reach(near), distance);
  for (; bits != 0; bits &= bits - 1) {
    const int lane = lowest_bit(bits);
    if (distance[lane] < nearest_reach(near))
      insert_nearest(near, node * TREE_FAN + (uint)lane, distance[lane]);
  }
}

/* Fills `near` with the leaves nearest to `leaf`, which counts itself. */
static inline void find_nearest_leaves(nearest_t* near, tree_t tree, blocks_t blocks, uint leaf) {
  const home_t home = home_of(tree, blocks, leaf);
  stack_t stack;
  take_leaves(near, tree, blocks, &home, leaf / TREE_FAN);
  push_root(&stack, tree);
  while (stack.depth > 0) {
    const uint node = stack.node[--stack.depth];
    const int level = stack.level[stack.depth], base = stack.depth;
    if (!(stack.key[stack.depth] < nearest_reach(near))) continue;
    if (level == 1) {
      if (node != leaf / TREE_FAN) take_leaves(near, tree, blocks, &home, node);
      continue;
    }
    real distance[LANES] FOR_LANES;
    uint bits = children_within(tree, blocks, &home, node, level, nearest_reach(near), distance);
    for (; bits != 0; bits &= bits - 1) {
      const int lane = lowest_bit(bits);
      push_sorted(&stack, base, node * TREE_FAN + (uint)lane, level - 1, distance[lane]);
    }
  }
}

#endif
