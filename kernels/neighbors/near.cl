/* Lists the near leaves of a leaf, all those within a bound of its box (docs/mathematics.md (10a)). The seeds
   of one leaf share this search, and every leaf that is not in the list is known to be beyond the bound. */
#ifndef POWERCELL_NEIGHBORS_NEAR
#define POWERCELL_NEIGHBORS_NEAR
#include "neighbors/blocks.cl"

#define NEAR_LEAST (CELL_DIMENSION == 3 ? 12 : 6)
#define NEAR_SPREAD (CELL_DIMENSION == 3 ? (real)1.4 : (real)1.1)
#define NEAR_TRIES 12

/* The box of a leaf's seeds relative to its first seed. The origin has the largest weight of the leaf, since
   the first seed may be inactive, and its weight would then swamp all others in rounding. */
typedef struct {
  origin_t origin;
  real low[DIMENSION], high[DIMENSION];
} home_t;

static inline home_t home_of(tree_t tree, blocks_t blocks, uint leaf) {
  home_t home;
  home.origin = origin_with_weight(tree.seeds[leaf * TREE_FAN], tree.node_low[leaf]);
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    home.low[k] = REAL_MAX;
    home.high[k] = -REAL_MAX;
  }
  EACH_LANE(lane) {
    reals q[DIMENSION], dw;
    seed_lanes(blocks, leaf, lane, &home.origin, q, &dw);
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      home.low[k] = least_of(lane_least(q[k]), home.low[k]);
      home.high[k] = most_of(lane_most(q[k]), home.high[k]);
    }
  }
  return home;
}

/* Squared distances of boxes from the home's, plus the excess dw of the home's weight over theirs. */
static inline reals lifted_distances(const home_t* home, const reals* a, const reals* b, reals dw) {
  reals d = dw;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    const reals gap =
        each_most(each_most(a[k] - all_lanes(home->high[k]), all_lanes(home->low[k]) - b[k]), ZERO);
    d = d + gap * gap;
  }
  return d;
}

/* A bit for each child of a node with lifted distance below `bound`. */
static inline uint children_below(tree_t tree, blocks_t blocks, const home_t* home, uint node, int level,
                                  real bound) {
  uint bits = 0;
  EACH_LANE(lane) {
    reals a[DIMENSION], b[DIMENSION], dw;
    node_lanes(blocks, block_of_children(tree, node, level), lane, &home->origin, a, b, &dw);
    bits |= lane_bits(lifted_distances(home, a, b, dw) < all_lanes(bound)) << lane;
  }
  return bits;
}

/* Writes the leaves with lifted distance below `bound` to `list`; returns their number, or NEAR_MOST + 1 if
   they do not fit. */
static inline int collect_near(tree_t tree, blocks_t blocks, const home_t* home, real bound,
                               __global uint* list) {
  uint node[TREE_STACK];
  uchar node_level[TREE_STACK];
  int depth = 1, found = 0;
  node[0] = 0;
  node_level[0] = (uchar)(tree.levels - 1);
  while (depth > 0) {
    const uint parent = node[--depth];
    const int level = node_level[depth];
    for (uint bits = children_below(tree, blocks, home, parent, level, bound); bits != 0; bits &= bits - 1) {
      const uint child = parent * TREE_FAN + (uint)lowest_bit(bits);
      if (level > 1) {
        node[depth] = child;
        node_level[depth++] = (uchar)(level - 1);
      } else {
        if (found == NEAR_MOST) return NEAR_MOST + 1;
        list[found++] = child;
      }
    }
  }
  return found;
}

/* Mean extent of the children of the leaf's parent, or of the nearest ancestor whose children have any. */
static inline real extent_around(tree_t tree, blocks_t blocks, uint leaf, const origin_t* o) {
  uint node = leaf;
  for (int level = 1; level < tree.levels; ++level) {
    node /= TREE_FAN;
    const uint present = children_end(tree, node, level - 1) - node * TREE_FAN;
    real part[LANES] FOR_LANES;
    EACH_LANE(lane) {
      reals a[DIMENSION], b[DIMENSION], dw, sum = ZERO;
      node_lanes(blocks, block_of_children(tree, node, level), lane, o, a, b, &dw);
      UNROLL for (int k = 0; k < DIMENSION; ++k) sum = sum + (b[k] - a[k]);
      store_lanes(choose(ZERO, sum, lanes_of(((1u << present) - 1) >> lane)), part + lane);
    }
    const real extent = sum_of_lanes(part);
    if (extent > 0) return extent / (real)(present * DIMENSION);
  }
  return 0;
}

/* Writes the list of `leaf` and returns its length; all other leaves have a lifted distance of at least
   `bound`. If no list of a fitting length is found, the length is 0 and the bound -REAL_MAX. */
static inline uint find_near(tree_t tree, blocks_t blocks, uint leaf, __global uint* list, real* bound) {
  if (tree.levels == 1) {
    list[0] = 0;
    *bound = REAL_MAX / 4;
    return 1;
  }
  const parts_t first = parts_of(tree.node_low[leaf]);
  *bound = -REAL_MAX;
  if (is_dead(&first)) return 0; /* nobody asks, and to it leaves that do not exist would be near */
  const home_t home = home_of(tree, blocks, leaf);
  const real extent = extent_around(tree, blocks, leaf, &home.origin) * NEAR_SPREAD;
  const real heaviest =
      weight_difference(tree.node_low[tree.level_offset[tree.levels] - 1], tree.node_low[leaf]);
  const uint least = min((uint)NEAR_LEAST, tree.level_offset[1]);
  real low = -heaviest, high = low, d = extent * extent;
  bool too_many = false;
  /* Not up to NOBODY, or leaves that do not exist would be near. */
  for (int k = 0; k < NEAR_TRIES && d > low && d < -NOBODY / 2; ++k) {
    const uint found = (uint)collect_near(tree, blocks, &home, d, list);
    if (found >= least && found <= NEAR_MOST) {
      *bound = d;
      return found;
    }
    if (found < least) {
      low = d;
    } else {
      high = d;
      too_many = true;
    }
    d = too_many ? low + (high - low) / 2 : 4 * d;
  }
  const uint found = (uint)collect_near(tree, blocks, &home, low, list);
  if (found > 0 && found <= NEAR_MOST) {
    *bound = low;
    return found;
  }
  *bound = -REAL_MAX;
  return 0;
}

#endif
