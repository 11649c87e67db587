/* Candidates from the packed tree (8 seeds a leaf, 8 nodes a parent, largest weight per node): first
   the seeds next to rank i in Hilbert order, nearest bisector first; then all nodes that the exact box
   test cannot exclude. Right for any weights: nothing is left out without the test. */
#ifndef POWERCELL_NEIGHBORS_TREE
#define POWERCELL_NEIGHBORS_TREE
#include "clip/bisector.cl"

#define TREE_FAN 8u
#define TREE_LEVELS 12 /* 8^11 leaves hold more seeds than a rank can number */
#define TREE_STACK (7 * TREE_LEVELS + 8)
#define WINDOW 24 /* seeds tried first on each side of rank i */

typedef struct {
  __global const seed_t* seeds;       /* by rank */
  __global const seed_t* node_low;    /* box of a node; .w is the largest weight below */
  __global const seed_t* node_high;
  __global const uint* level_offset;
  int levels;
  uint count;
} tree_t;

/* A lower bound of |y-p_j|^2 - w_j - |y|^2 + w_i over the box [low, high] of the cell and the seeds j of
   the node: below 0, some seed may cut (docs/mathematics.md). A rounding margin is taken off. */
static inline real node_bound(tree_t tree, uint node, seed_t seed, const real* low, const real* high) {
  real a[DIMENSION], b[DIMENSION], value = 0, size = 0;
  const seed_t node_low = tree.node_low[node];
  difference(node_low, seed, a);
  difference(tree.node_high[node], seed, b);
  for (int k = 0; k < DIMENSION; ++k) {
    const real dl = fmax(fmax(a[k] - low[k], low[k] - b[k]), (real)0);
    const real dh = fmax(fmax(a[k] - high[k], high[k] - b[k]), (real)0);
    value += fmin(dl * dl - low[k] * low[k], dh * dh - high[k] * high[k]);
    const real s = fabs(a[k]) + fabs(b[k]) + fabs(low[k]) + fabs(high[k]);
    size += s * s;
  }
  const real dw = weight_difference(seed, node_low);
  return value + dw - 8 * REAL_EPSILON * (size + fabs(dw));
}

/* The same for one seed, over the corner of the box that is worst. */
static inline bool seed_may_cut(seed_t seed, seed_t other, const real* low, const real* high) {
  real q[DIMENSION], reach = 0;
  difference(other, seed, q);
  for (int k = 0; k < DIMENSION; ++k) reach += fmax(q[k] * low[k], q[k] * high[k]);
  return 2 * reach > norm2(q) + weight_difference(seed, other);
}

/* Signed distance of the bisector from the seed, times a common positive factor for sorting. */
static inline real bisector_distance(seed_t seed, seed_t other) {
  real q[DIMENSION];
  difference(other, seed, q);
  const real q2 = norm2(q);
  return (q2 + weight_difference(seed, other)) / sqrt(q2);
}

/* Cuts by the seeds first .. last-1 except i, nearest bisector first. */
static inline int cut_by_window(cell_t* cell, tree_t tree, uint i, uint first, uint last) {
  real key[2 * WINDOW + 1];
  const seed_t seed = tree.seeds[i];
  const int count = (int)(last - first);
  for (int k = 0; k < count; ++k)
    key[k] = first + (uint)k == i ? REAL_MAX : bisector_distance(seed, tree.seeds[first + (uint)k]);
  real reach = sqrt(cell_radius2(cell)) * 2;
  for (int step = 0; step + 1 < count; ++step) {
    int best = 0;
    for (int k = 1; k < count; ++k)
      if (key[k] < key[best]) best = k;
    if (key[best] >= reach) break; /* the plane is beyond every vertex, and so are the rest */
    key[best] = REAL_MAX;
    const uint j = first + (uint)best;
    const int cut = cut_by_seed(cell, seed, tree.seeds[j], (int)j);
    if (cut == CUT_SHRUNK) reach = sqrt(cell_radius2(cell)) * 2;
    if (cut > CUT_SHRUNK) return cut;
  }
  return CUT_SHRUNK;
}

/* Cuts by the seeds of leaf `leaf` outside first .. last-1 that the box does not exclude. */
static inline int cut_by_leaf(cell_t* cell, tree_t tree, uint i, uint leaf, uint first, uint last,
                              real* low, real* high) {
  const seed_t seed = tree.seeds[i];
  const uint end = min((leaf + 1) * TREE_FAN, tree.count);
  for (uint j = leaf * TREE_FAN; j < end; ++j) {
    if (j >= first && j < last) continue;
    const seed_t other = tree.seeds[j];
    if (!seed_may_cut(seed, other, low, high)) continue;
    const int cut = cut_by_seed(cell, seed, other, (int)j);
    if (cut == CUT_SHRUNK) cell_box(cell, low, high);
    if (cut > CUT_SHRUNK) return cut;
  }
  return CUT_SHRUNK;
}

/* Puts the children of a node that may cut on the stack, the likeliest on top. Returns the new depth. */
static inline int push_children(tree_t tree, int level, uint node, seed_t seed, const real* low,
                                const real* high, uint* stack, uchar* stack_level, int depth) {
  real bound[TREE_FAN];
  const int base = depth;
  const uint first = node * TREE_FAN;
  const uint end = min(first + TREE_FAN, tree.level_offset[level] - tree.level_offset[level - 1]);
  for (uint child = first; child < end; ++child) {
    const real b = node_bound(tree, tree.level_offset[level - 1] + child, seed, low, high);
    if (b >= 0) continue;
    int at = depth++;
    for (; at > base && bound[at - base - 1] < b; --at) {
      bound[at - base] = bound[at - base - 1];
      stack[at] = stack[at - 1];
    }
    bound[at - base] = b;
    stack[at] = child;
    stack_level[depth - 1] = (uchar)(level - 1);
  }
  return depth;
}

/* Clips the cell of rank i, started as a region, by all other seeds. Returns a PIECE status. */
static inline int clip_by_tree(cell_t* cell, tree_t tree, uint i) {
  const uint first = i > WINDOW ? i - WINDOW : 0;
  const uint last = min(i + WINDOW + 1, tree.count);
  int cut = cut_by_window(cell, tree, i, first, last);
  if (cut > CUT_SHRUNK) return piece_status(cut);
  if (last - first == tree.count) return PIECE_WHOLE;

  uint stack[TREE_STACK];
  uchar stack_level[TREE_STACK];
  real low[DIMENSION], high[DIMENSION];
  const seed_t seed = tree.seeds[i];
  cell_box(cell, low, high);
  int depth = 1;
  stack[0] = 0;
  stack_level[0] = (uchar)(tree.levels - 1);
  while (depth > 0) {
    const uint node = stack[--depth];
    const int level = stack_level[depth];
    if (node_bound(tree, tree.level_offset[level] + node, seed, low, high) >= 0) continue;
    if (level > 0) {
      depth = push_children(tree, level, node, seed, low, high, stack, stack_level, depth);
      continue;
    }
    cut = cut_by_leaf(cell, tree, i, node, first, last, low, high);
    if (cut > CUT_SHRUNK) return piece_status(cut);
  }
  return PIECE_WHOLE;
}

#endif
