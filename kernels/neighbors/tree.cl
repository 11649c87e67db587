/* Candidates from the packed tree (8 seeds a leaf, 8 nodes a parent, largest weight per node): first
   the seeds of the leaves nearest by power distance, nearest bisector first; then all nodes that the
   exact box test cannot exclude. Right for any weights: nothing is left out without the test. */
#ifndef POWERCELL_NEIGHBORS_TREE
#define POWERCELL_NEIGHBORS_TREE
#include "clip/bisector.cl"

#define TREE_FAN 8u
#define TREE_LEVELS 12 /* 8^11 leaves hold more seeds than a rank can number */
#define TREE_STACK (7 * TREE_LEVELS + 8)
#define NEAR_LEAVES (CELL_DIMENSION == 3 ? 8 : 4) /* leaves whose seeds are tried first */
#define NEAR_LEAVES_MOST 8
#define NEAR_SEEDS 64 /* NEAR_LEAVES_MOST * TREE_FAN */

typedef struct {
  __global const seed_t* seeds;       /* by rank */
  __global const seed_t* node_low;    /* box of a node; .w is the largest weight below */
  __global const seed_t* node_high;
  __global const uint* level_offset;
  int levels;
  uint count;
} tree_t;

/* Nodes still to visit, the next on top. */
typedef struct {
  uint node[TREE_STACK]; /* number within its level */
  real key[TREE_STACK];  /* power distance of the node */
  uchar level[TREE_STACK];
  int depth;
} stack_t;

/* Sorts a child into the entries above `base`, the least key on top. */
static inline void push_sorted(stack_t* stack, int base, uint node, int level, real key) {
  int at = stack->depth++;
  stack->level[at] = (uchar)level;
  for (; at > base && stack->key[at - 1] < key; --at) {
    stack->key[at] = stack->key[at - 1];
    stack->node[at] = stack->node[at - 1];
  }
  stack->key[at] = key;
  stack->node[at] = node;
}

/* The root alone. */
static inline void push_root(stack_t* stack, tree_t tree) {
  stack->depth = 1;
  stack->node[0] = 0;
  stack->key[0] = -REAL_MAX;
  stack->level[0] = (uchar)(tree.levels - 1);
}

/* The nodes of level `level` below node `node` of the level above end before this. */
static inline uint children_end(tree_t tree, uint node, int level) {
  return min((node + 1) * TREE_FAN, tree.level_offset[level + 1] - tree.level_offset[level]);
}

/* Least power distance of the seed from a node: its box and its largest weight. */
static inline real node_distance(tree_t tree, uint node, seed_t seed) {
  real a[DIMENSION], b[DIMENSION], near2 = 0;
  const seed_t node_low = tree.node_low[node];
  difference(node_low, seed, a);
  difference(tree.node_high[node], seed, b);
  for (int k = 0; k < DIMENSION; ++k) {
    const real gap = fmax(fmax(a[k], -b[k]), (real)0);
    near2 += gap * gap;
  }
  return near2 + weight_difference(seed, node_low);
}

/* True if some seed of the node may cut the box [low, high] of the cell: the least value of
   |y-p_j|^2 - w_j - |y|^2 + w_i over the box and the seeds j of the node is below 0
   (docs/mathematics.md (9)). A rounding margin is taken off. */
static inline bool node_may_cut(tree_t tree, uint node, seed_t seed, const real* low, const real* high) {
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
  return value + dw < 8 * REAL_EPSILON * (size + fabs(dw));
}

/* The same for one seed, over the corner of the box that is worst (docs/mathematics.md (10)). */
static inline bool seed_may_cut(seed_t seed, seed_t other, const real* low, const real* high) {
  real q[DIMENSION], reach = 0;
  difference(other, seed, q);
  for (int k = 0; k < DIMENSION; ++k) reach += fmax(q[k] * low[k], q[k] * high[k]);
  return 2 * reach > norm2(q) + weight_difference(seed, other);
}

/* Twice the signed distance of the bisector from the seed (docs/mathematics.md (4)). */
static inline real bisector_distance(seed_t seed, seed_t other) {
  real q[DIMENSION];
  difference(other, seed, q);
  const real q2 = norm2(q);
  return (q2 + weight_difference(seed, other)) / sqrt(q2);
}

/* The NEAR_LEAVES leaves nearest to the seed, nearest first; returns how many there are. */
static inline int find_near_leaves(tree_t tree, seed_t seed, stack_t* stack, uint* leaf) {
  real best[NEAR_LEAVES_MOST];
  int found = 0;
  push_root(stack, tree);
  while (stack->depth > 0) {
    const uint node = stack->node[--stack->depth];
    const int level = stack->level[stack->depth];
    const real d = stack->key[stack->depth];
    if (found == NEAR_LEAVES && d >= best[found - 1]) continue;
    if (level > 0) {
      const int base = stack->depth;
      const uint end = children_end(tree, node, level - 1);
      for (uint child = node * TREE_FAN; child < end; ++child) {
        const real k = node_distance(tree, tree.level_offset[level - 1] + child, seed);
        if (found < NEAR_LEAVES || k < best[found - 1]) push_sorted(stack, base, child, level - 1, k);
      }
      continue;
    }
    int at = found < NEAR_LEAVES ? found++ : found - 1;
    for (; at > 0 && best[at - 1] > d; --at) {
      best[at] = best[at - 1];
      leaf[at] = leaf[at - 1];
    }
    best[at] = d;
    leaf[at] = node;
  }
  return found;
}

/* Cuts by the seeds of the given leaves except i, nearest bisector first. */
static inline int cut_by_near(cell_t* cell, tree_t tree, uint i, const uint* leaf, int leaves) {
  real key[NEAR_SEEDS];
  const seed_t seed = tree.seeds[i];
  for (int k = 0; k < leaves * (int)TREE_FAN; ++k) {
    const uint j = leaf[k / (int)TREE_FAN] * TREE_FAN + (uint)(k % (int)TREE_FAN);
    key[k] = j == i || j >= tree.count ? REAL_MAX : bisector_distance(seed, tree.seeds[j]);
  }
  real reach = sqrt(cell_radius2(cell)) * 2;
  for (;;) {
    int best = 0;
    for (int k = 1; k < leaves * (int)TREE_FAN; ++k)
      if (key[k] < key[best]) best = k;
    if (key[best] >= reach) return CUT_SHRUNK; /* that plane is beyond every vertex, and so are the rest */
    key[best] = REAL_MAX;
    const uint j = leaf[best / (int)TREE_FAN] * TREE_FAN + (uint)(best % (int)TREE_FAN);
    const int cut = cut_by_seed(cell, seed, tree.seeds[j], (int)j);
    if (cut == CUT_SHRUNK) reach = sqrt(cell_radius2(cell)) * 2;
    if (cut > CUT_SHRUNK) return cut;
  }
}

/* Cuts by the seeds of a leaf that the cell's box does not exclude, and keeps the box. */
static inline int cut_by_leaf(cell_t* cell, tree_t tree, uint i, uint leaf, real* low, real* high) {
  const seed_t seed = tree.seeds[i];
  const uint end = min((leaf + 1) * TREE_FAN, tree.count);
  int result = CUT_NONE;
  for (uint j = leaf * TREE_FAN; j < end; ++j) {
    const seed_t other = tree.seeds[j];
    if (j == i || !seed_may_cut(seed, other, low, high)) continue;
    const int cut = cut_by_seed(cell, seed, other, (int)j);
    if (cut > CUT_SHRUNK) return cut;
    if (cut == CUT_SHRUNK) {
      cell_box(cell, low, high);
      result = CUT_SHRUNK;
    }
  }
  return result;
}

/* Clips the cell of rank i, started as a region, by all other seeds. Returns a PIECE status. */
static inline int clip_by_tree(cell_t* cell, tree_t tree, uint i) {
  stack_t stack;
  uint leaf[NEAR_LEAVES_MOST];
  real low[DIMENSION], high[DIMENSION];
  const seed_t seed = tree.seeds[i];
  const int leaves = find_near_leaves(tree, seed, &stack, leaf);
  int cut = cut_by_near(cell, tree, i, leaf, leaves);
  if (cut > CUT_SHRUNK) return piece_status(cut);
  if (leaves < NEAR_LEAVES) return PIECE_WHOLE;

  cell_box(cell, low, high);
  push_root(&stack, tree);
  int tested = 0; /* entries from here on were tested against the present box */
  while (stack.depth > 0) {
    const uint node = stack.node[--stack.depth];
    const int level = stack.level[stack.depth];
    if (stack.depth < tested) {
      tested = stack.depth;
      if (!node_may_cut(tree, tree.level_offset[level] + node, seed, low, high)) continue;
    }
    if (level > 0) {
      const int base = stack.depth;
      const uint end = children_end(tree, node, level - 1);
      for (uint child = node * TREE_FAN; child < end; ++child) {
        const uint at = tree.level_offset[level - 1] + child;
        if (node_may_cut(tree, at, seed, low, high))
          push_sorted(&stack, base, child, level - 1, node_distance(tree, at, seed));
      }
      continue;
    }
    bool done = false;
    for (int k = 0; k < NEAR_LEAVES; ++k) done |= leaf[k] == node;
    if (done) continue;
    cut = cut_by_leaf(cell, tree, i, node, low, high);
    if (cut == CUT_SHRUNK) tested = stack.depth;
    if (cut > CUT_SHRUNK) return piece_status(cut);
  }
  return PIECE_WHOLE;
}

#endif
