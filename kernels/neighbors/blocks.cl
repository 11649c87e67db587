/* The packed tree by blocks of eight, each coordinate of the eight side by side, so that one vector
   operation can do a whole leaf or all children of a node (base/lanes.cl). A block of seeds: coordinates,
   weight. A block of nodes: low corner, high corner, largest weight. In single precision each is a high and a
   low row. */
#ifndef POWERCELL_NEIGHBORS_BLOCKS
#define POWERCELL_NEIGHBORS_BLOCKS
#include "base/lanes.cl"
#include "neighbors/tree.cl"

#if REAL_BITS == 32
#define BLOCK_PARTS 2
#else
#define BLOCK_PARTS 1
#endif
#define BLOCK_ROW (LANES * BLOCK_PARTS)
#define SEED_BLOCK ((DIMENSION + 1) * BLOCK_ROW)
#define NODE_BLOCK ((2 * DIMENSION + 1) * BLOCK_ROW)
/* Of lanes behind the last seed or child: nothing is cut by it (DEAD_WEIGHT in base/point.cl). */
#define NOBODY (-REAL_MAX / 4)

typedef struct {
  __global const stored_real* seeds; /* per leaf */
  __global const stored_real* nodes; /* per node above the leaves: its children */
  __global const uint* near;         /* per leaf: NEAR_MOST leaves (near.cl) */
  __global const uint* near_count;   /* per leaf */
  __global const stored_real*
      near_bound; /* per leaf: least lifted distance of a seed outside the near leaves, (10b) */
} blocks_t;

/* A point that lanes are taken relative to. */
typedef struct {
  real high[DIMENSION + 1];
  real low[DIMENSION + 1];
} origin_t;

#if REAL_BITS == 32
static inline origin_t origin_of(seed_t p) {
  origin_t o;
  o.high[0] = p.high.x;
  o.high[1] = p.high.y;
  if (DIMENSION == 3) o.high[2 - (DIMENSION == 2)] = p.high.z;
  o.high[DIMENSION] = p.high.w;
  o.low[0] = p.low.x;
  o.low[1] = p.low.y;
  if (DIMENSION == 3) o.low[2 - (DIMENSION == 2)] = p.low.z;
  o.low[DIMENSION] = p.low.w;
  return o;
}
/* At p with the weight of `heavy`. */
static inline origin_t origin_with_weight(seed_t p, seed_t heavy) {
  p.high.w = heavy.high.w;
  p.low.w = heavy.low.w;
  return origin_of(p);
}
/* Lanes of row `row` of a block less coordinate k of the origin (k == DIMENSION: the weight). `block` begins
   at the first of these lanes. */
static inline reals block_row(__global const stored_real* block, int row, const origin_t* o, int k) {
  return (load_stored_lanes(block + row * BLOCK_ROW) - o->high[k]) +
         (load_stored_lanes(block + row * BLOCK_ROW + LANES) - o->low[k]);
}
#define LOWEST_PART low
static inline void store_part(__global stored_real* block, int row, int lane, real high, real low) {
  block[row * BLOCK_ROW + lane] = high;
  block[row * BLOCK_ROW + LANES + lane] = low;
}
#else
static inline origin_t origin_of(seed_t p) {
  origin_t o;
  o.high[0] = p.x;
  o.high[1] = p.y;
  if (DIMENSION == 3) o.high[2 - (DIMENSION == 2)] = p.z;
  o.high[DIMENSION] = p.w;
  return o;
}
static inline origin_t origin_with_weight(seed_t p, seed_t heavy) {
  p.w = heavy.w;
  return origin_of(p);
}
static inline reals block_row(__global const stored_real* block, int row, const origin_t* o, int k) {
  return load_stored_lanes(block + row * BLOCK_ROW) - all_lanes(o->high[k]);
}
#define LOWEST_PART high
static inline void store_part(__global stored_real* block, int row, int lane, real high, real low) {
  block[row * BLOCK_ROW + lane] = (stored_real)high;
  (void)low;
}
#endif

/* At a seed with its weight less what it may be off: so no search leaves out what the true one would cut. */
static inline origin_t search_origin(seed_t p) {
  origin_t o = origin_of(p);
  o.LOWEST_PART[DIMENSION] -= 4 * blur_of(p).weight;
  return o;
}

/* Coordinates of p into the rows first .. first+DIMENSION-1 of a block. */
static inline void store_point(__global stored_real* block, int first, int lane, seed_t p) {
  const origin_t o = origin_of(p);
  UNROLL for (int k = 0; k < DIMENSION; ++k) store_part(block, first + k, lane, o.high[k], o.low[k]);
}

static inline void pack_seed_block(tree_t tree, uint leaf, __global stored_real* seeds) {
  __global stored_real* block = seeds + (size_t)leaf * SEED_BLOCK;
  const uint first = leaf * TREE_FAN, end = min(first + TREE_FAN, tree.count);
  for (uint lane = 0; lane < TREE_FAN; ++lane) {
    const bool present = first + lane < end;
    const seed_t p = tree.seeds[present ? first + lane : first];
    const origin_t o = origin_of(p);
    store_point(block, 0, (int)lane, p);
    store_part(block, DIMENSION, (int)lane, present ? o.high[DIMENSION] : NOBODY,
               present ? o.low[DIMENSION] : 0);
  }
}

/* The block of children of a node is numbered like the nodes, from the first one above the leaves. */
static inline uint block_of_children(tree_t tree, uint node, int level) {
  return tree.level_offset[level] + node - tree.level_offset[1];
}

static inline void pack_node_block(tree_t tree, uint node, int level, __global stored_real* nodes) {
  __global stored_real* block = nodes + (size_t)block_of_children(tree, node, level) * NODE_BLOCK;
  const uint first = node * TREE_FAN, end = children_end(tree, node, level - 1);
  for (uint lane = 0; lane < TREE_FAN; ++lane) {
    const bool present = first + lane < end;
    const uint child = tree.level_offset[level - 1] + (present ? first + lane : first);
    const origin_t o = origin_of(tree.node_low[child]);
    store_point(block, 0, (int)lane, tree.node_low[child]);
    store_point(block, DIMENSION, (int)lane, tree.node_high[child]);
    store_part(block, 2 * DIMENSION, (int)lane, present ? o.high[DIMENSION] : NOBODY,
               present ? o.low[DIMENSION] : 0);
  }
}

/* Lanes from `lane` on relative to `o`: positions q, and by how much the weight at `o` exceeds theirs. */
static inline void seed_lanes(blocks_t blocks, uint leaf, uint lane, const origin_t* o, reals* q, reals* dw) {
  __global const stored_real* block = blocks.seeds + (size_t)leaf * SEED_BLOCK + lane;
  UNROLL for (int k = 0; k < DIMENSION; ++k) q[k] = block_row(block, k, o, k);
  *dw = -block_row(block, DIMENSION, o, DIMENSION);
}
static inline void node_lanes(blocks_t blocks, uint block_number, uint lane, const origin_t* o, reals* a,
                              reals* b, reals* dw) {
  __global const stored_real* block = blocks.nodes + (size_t)block_number * NODE_BLOCK + lane;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    a[k] = block_row(block, k, o, k);
    b[k] = block_row(block, DIMENSION + k, o, k);
  }
  *dw = -block_row(block, 2 * DIMENSION, o, DIMENSION);
}

#endif
