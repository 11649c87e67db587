/* The packed tree of the seeds: 8 seeds to a leaf, 8 nodes to a parent, with a box and the largest weight of
   each node; and the search for the leaves nearest to a seed by power distance. */
#ifndef POWERCELL_NEIGHBORS_TREE
#define POWERCELL_NEIGHBORS_TREE
#include "cell/bisector.cl"

#define TREE_FAN 8u
#define TREE_LEVELS 12 /* 8^11 leaves hold more seeds than a rank can number */
#define TREE_STACK (7 * TREE_LEVELS + 8)
#define NEAR_LEAVES (CELL_DIMENSION == 3 ? 8 : 4) /* leaves whose seeds are tried first */
#define NEAREST_MOST 12

typedef struct {
  __global const seed_t* seeds;    /* by rank */
  __global const seed_t* node_low; /* box of a node; .w is the largest weight below */
  __global const seed_t* node_high;
  __global const uint* level_offset;
  int levels;
  uint count;
} tree_t;

/* Nodes still to visit, the next on top. */
typedef struct {
  uint node[TREE_STACK]; /* number within its level */
  real key[TREE_STACK];  /* lower bound of the distance of its seeds */
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

/* The end of the children of node `node`, which are nodes of level `level`. */
static inline uint children_end(tree_t tree, uint node, int level) {
  return min((node + 1) * TREE_FAN, tree.level_offset[level + 1] - tree.level_offset[level]);
}

/* Lower bound of pow_j(p_i) - pow_i(p_i) over the seeds j of a node, by its box and its largest weight. */
static inline real node_distance(tree_t tree, uint node, seed_t seed) {
  real a[DIMENSION], b[DIMENSION], near2 = 0;
  const seed_t node_low = tree.node_low[node];
  difference(node_low, seed, a);
  difference(tree.node_high[node], seed, b);
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const real gap = fmax(fmax(a[k], -b[k]), (real)0);
    near2 += gap * gap;
  }
  return near2 + weight_difference(seed, node_low);
}

/* Twice the signed distance of the bisector from the seed (docs/mathematics.md (4)). */
static inline real bisector_distance(seed_t seed, seed_t other) {
  real q[DIMENSION];
  difference(other, seed, q);
  const real q2 = norm2(q);
  return (q2 + weight_difference(seed, other)) / sqrt(most_of(q2, REAL_LEAST));
}

/* Up to `most` leaves, nearest first. */
typedef struct {
  uint leaf[NEAREST_MOST];
  real distance[NEAREST_MOST];
  int count, most;
} nearest_t;

static inline nearest_t nothing_near(int most) {
  nearest_t near;
  near.count = 0;
  near.most = most;
  return near;
}

/* Leaves at this distance or beyond are not kept. */
static inline real nearest_reach(const nearest_t* near) {
  return near->count < near->most ? REAL_MAX : near->distance[near->most - 1];
}

static inline void insert_nearest(nearest_t* near, uint leaf, real distance) {
  int at = near->count < near->most ? near->count++ : near->most - 1;
  for (; at > 0 && distance < near->distance[at - 1]; --at) {
    near->distance[at] = near->distance[at - 1];
    near->leaf[at] = near->leaf[at - 1];
  }
  near->distance[at] = distance;
  near->leaf[at] = leaf;
}

/* The NEAR_LEAVES leaves nearest to the seed. */
static inline nearest_t find_near_leaves(tree_t tree, seed_t seed, stack_t* stack) {
  nearest_t near = nothing_near(NEAR_LEAVES);
  push_root(stack, tree);
  while (stack->depth > 0) {
    const uint node = stack->node[--stack->depth];
    const int level = stack->level[stack->depth], base = stack->depth;
    const real d = stack->key[stack->depth];
    if (!(d < nearest_reach(&near))) continue;
    if (level == 0) {
      insert_nearest(&near, node, d);
      continue;
    }
    const uint end = children_end(tree, node, level - 1);
    for (uint child = node * TREE_FAN; child < end; ++child) {
      const real k = node_distance(tree, tree.level_offset[level - 1] + child, seed);
      if (k < nearest_reach(&near)) push_sorted(stack, base, child, level - 1, k);
    }
  }
  return near;
}

#endif
