/* Clips a cell by all seeds that can cut it: first those of the leaves near its own (near.cl), nearest
   bisector first; then, unless the bound of that list proves the cell done, all nodes of the tree that the
   exact box test cannot exclude. Right for any weights: nothing is left out without a proof. */
#ifndef POWERCELL_NEIGHBORS_SEARCH
#define POWERCELL_NEIGHBORS_SEARCH
#include "neighbors/order.cl"

/* Which of eight nodes have a seed that may cut the box [low, high] of the cell: the least value of
   |y-p_j|^2 - w_j - |y|^2 + w_i over the box and the seeds j of the node is below 0
   (docs/mathematics.md (9)). A rounding margin is taken off. */
static inline mask8 nodes_may_cut(const real8* a, const real8* b, real8 dw, const real* low, const real* high) {
  real8 value = dw, size = size8(dw);
  for (int k = 0; k < DIMENSION; ++k) {
    const real8 l = all_lanes(low[k]), h = all_lanes(high[k]);
    const real8 dl = most8(most8(a[k] - l, l - b[k]), ZERO8);
    const real8 dh = most8(most8(a[k] - h, h - b[k]), ZERO8);
    value = value + least8(dl * dl - l * l, dh * dh - h * h);
    const real8 s = size8(a[k]) + size8(b[k]) + size8(l) + size8(h);
    size = size + s * s;
  }
  return value < size * all_lanes(8 * REAL_EPSILON);
}

/* Cuts by those seeds of a leaf whose bits are set in `left` and that the cell's box does not exclude, and
   keeps the box. */
static inline int cut_by_leaf(cell_t* cell, tree_t tree, blocks_t blocks, uint i, uint leaf, uint left,
                              real* low, real* high) {
  const seed_t seed = tree.seeds[i];
  const origin_t origin = origin_of(seed);
  real8 q[DIMENSION], dw;
  seed_lanes(blocks, leaf, &origin, q, &dw);
  for (;;) {
    left &= lane_bits(seeds_may_cut(q, dw, low, high));
    int cut = CUT_NONE;
    while (left != 0 && cut != CUT_SHRUNK) {
      const uint j = leaf * TREE_FAN + (uint)lowest_bit(left);
      left &= left - 1;
      cut = cut_by_seed(cell, seed, tree.seeds[j], (int)j);
      if (cut > CUT_SHRUNK) return cut;
    }
    if (cut != CUT_SHRUNK) return CUT_NONE;
    find_box(&cell->at, low, high);
  }
}

/* True if no seed outside the near leaves can cut the cell: their distance from the home
   box against the radius of the cell (docs/mathematics.md (10b)). */
static inline bool near_is_enough(const cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  const uint home = i / TREE_FAN;
  const seed_t seed = tree.seeds[i], first = tree.seeds[home * TREE_FAN];
  const real bound = blocks.near_bound[home];
  if (tree.levels == 1 || bound <= -REAL_MAX / 2) return bound > 0;
  const real heaviest = weight_difference(tree.node_low[tree.level_offset[tree.levels] - 1], first);
  const real lifted2 = bound + heaviest, own = bound + weight_difference(seed, first);
  return lifted2 > 0 && own * (1 - 64 * REAL_EPSILON) > 2 * sqrt(find_radius2(&cell->at) * lifted2);
}

/* Pushes the children of a node that may cut the cell and are not near, nearest on top. */
static inline void push_children(stack_t* stack, tree_t tree, blocks_t blocks, uint node, int level,
                                 const home_t* home, real bound, const origin_t* origin, const real* low,
                                 const real* high) {
  real8 a[DIMENSION], b[DIMENSION], dw;
  const uint block = block_of_children(tree, node, level);
  node_lanes(blocks, block, origin, a, b, &dw);
  uint bits = lane_bits(nodes_may_cut(a, b, dw, low, high));
  if (bits == 0) return;
  real8 distance = dw;
  for (int k = 0; k < DIMENSION; ++k) {
    const real8 gap = most8(most8(a[k], -b[k]), ZERO8);
    distance = distance + gap * gap;
  }
  real key[LANES];
  store8(distance, key);
  if (level == 1) {
    node_lanes(blocks, block, &home->origin, a, b, &dw);
    bits &= ~lane_bits(lifted_distance8(home, a, b, dw) < all_lanes(bound));
  }
  const int base = stack->depth;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = lowest_bit(bits);
    push_sorted(stack, base, node * TREE_FAN + (uint)lane, level - 1, key[lane]);
  }
}

/* Cuts by all seeds outside the near leaves that may cut the cell. */
static inline int cut_by_rest(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  stack_t stack;
  real low[DIMENSION], high[DIMENSION];
  const origin_t origin = origin_of(tree.seeds[i]);
  const home_t home = home_of(tree, blocks, i / TREE_FAN);
  const real bound = blocks.near_bound[i / TREE_FAN];
  find_box(&cell->at, low, high);
  push_root(&stack, tree);
  while (stack.depth > 0) {
    const uint node = stack.node[--stack.depth];
    const int level = stack.level[stack.depth];
    if (level > 0) {
      push_children(&stack, tree, blocks, node, level, &home, bound, &origin, low, high);
      continue;
    }
    uint left = (1u << min(TREE_FAN, tree.count - node * TREE_FAN)) - 1;
    if (node == i / TREE_FAN) left &= ~(1u << i % TREE_FAN);
    const int cut = cut_by_leaf(cell, tree, blocks, i, node, left, low, high);
    if (cut > CUT_SHRUNK) return cut;
  }
  return CUT_NONE;
}

/* Clips the cell of rank i, started as a region, by all other seeds. Returns a PIECE status. */
static inline int clip_by_tree(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  int cut = cut_by_near(cell, tree, blocks, i);
  if (cut > CUT_SHRUNK) return piece_status(cut);
  if (near_is_enough(cell, tree, blocks, i)) return PIECE_WHOLE;
  cut = cut_by_rest(cell, tree, blocks, i);
  return cut > CUT_SHRUNK ? piece_status(cut) : PIECE_WHOLE;
}

#endif
