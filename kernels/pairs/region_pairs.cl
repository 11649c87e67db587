/* Lists the (region, seed) pairs that may meet: walks down a packed tree of the regions with half-spaces that
   contain the cell of the seed (docs/mathematics.md (11)). The half-spaces come from the seeds near it and
   from the owner of the middle of each box. Any seeds would be right: a pair that is listed needlessly turns
   out empty when it is clipped. */
#include "base/point.cl"
#include "neighbors/tree.cl"

#define TESTERS 16
#define NO_SEED 0xffffffffu

/* 2 q.y <= offset with y relative to the seed; `scale` is the size of the terms of offset, `sum` that of q.
 */
typedef struct {
  real q[DIMENSION];
  real offset;
  real scale, sum;
  blur_t blur; /* of the seed */
} half_space_t;

typedef struct {
  half_space_t space[TESTERS + 1]; /* the last one is that of the owner of the box or region at hand */
  real key[TESTERS];
  int count;
} testers_t;

static inline half_space_t half_space_of(seed_t seed, seed_t other) {
  half_space_t h;
  difference(other, seed, h.q);
  const real q2 = norm2(h.q), dw = weight_difference(seed, other);
  h.offset = q2 + dw;
  h.scale = q2 + fabs(dw);
  h.sum = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) h.sum += fabs(h.q[k]);
  h.blur = blur_of(seed);
  return h;
}

/* A bound for the error of 2 q.y - offset where |y_k| <= reach. */
static inline real half_space_error(const half_space_t* h, real reach) {
  return 32 * REAL_EPSILON * (h->scale + 2 * h->sum * reach) + plane_blur(h->blur, DIMENSION * reach, h->sum);
}

/* Keeps the half-spaces nearest to the seed, nearest first. */
static inline void add_tester(testers_t* testers, seed_t seed, seed_t other) {
  const real key = bisector_distance(seed, other);
  if (testers->count == TESTERS && !(key < testers->key[TESTERS - 1])) return;
  int at = testers->count < TESTERS ? testers->count++ : TESTERS - 1;
  for (; at > 0 && key < testers->key[at - 1]; --at) {
    testers->key[at] = testers->key[at - 1];
    testers->space[at] = testers->space[at - 1];
  }
  testers->key[at] = key;
  testers->space[at] = half_space_of(seed, other);
}

static inline void find_testers(tree_t tree, uint i, stack_t* stack, testers_t* testers) {
  const seed_t seed = tree.seeds[i];
  const nearest_t near = find_near_leaves(tree, seed, stack);
  testers->count = 0;
  for (int k = 0; k < near.count; ++k) {
    const uint end = min((near.leaf[k] + 1) * TREE_FAN, tree.count);
    for (uint j = near.leaf[k] * TREE_FAN; j < end; ++j)
      if (j != i) add_tester(testers, seed, tree.seeds[j]);
  }
}

/* True if the box [a, b] lies outside the half-space, with a margin for rounding. */
static inline bool box_is_outside(const half_space_t* h, const real* a, const real* b) {
  real value = -h->offset, reach = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    value += 2 * fmin(h->q[k] * a[k], h->q[k] * b[k]);
    reach = fmax(reach, fmax(fabs(a[k]), fabs(b[k])));
  }
  return value > half_space_error(h, reach);
}

/* True if the box lies outside one of the half-spaces. */
static inline bool box_is_excluded(const testers_t* testers, bool owned, seed_t seed, seed_t low,
                                   seed_t high) {
  real a[DIMENSION], b[DIMENSION];
  difference(low, seed, a);
  difference(high, seed, b);
  if (owned && box_is_outside(&testers->space[TESTERS], a, b)) return true;
  for (int k = 0; k < testers->count; ++k)
    if (box_is_outside(&testers->space[k], a, b)) return true;
  return false;
}

typedef struct {
  __global const seed_t* corners;
  __global const uint* offset;
  __global const uint* vertex;
} region_corners_t;

static inline bool region_is_outside(const half_space_t* h, region_corners_t regions, uint region,
                                     seed_t seed) {
  for (uint slot = regions.offset[region]; slot < regions.offset[region + 1]; ++slot) {
    real y[DIMENSION], value = -h->offset, reach = 0;
    difference(regions.corners[regions.vertex[slot]], seed, y);
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      value += 2 * h->q[k] * y[k];
      reach = fmax(reach, fabs(y[k]));
    }
    if (!(value > half_space_error(h, reach))) return false;
  }
  return true;
}

static inline bool region_is_excluded(const testers_t* testers, bool owned, region_corners_t regions,
                                      uint region, seed_t seed) {
  if (owned && region_is_outside(&testers->space[TESTERS], regions, region, seed)) return true;
  for (int k = 0; k < testers->count; ++k)
    if (region_is_outside(&testers->space[k], regions, region, seed)) return true;
  return false;
}

/* Makes the owner the last tester. False if `owner` is NO_SEED or the seed itself. */
static inline bool take_owner(testers_t* testers, tree_t tree, uint i, uint owner) {
  if (owner == NO_SEED || owner == i) return false;
  testers->space[TESTERS] = half_space_of(tree.seeds[i], tree.seeds[owner]);
  return true;
}

/* A seed of least power at `x`. */
static inline uint seed_of_least_power(tree_t tree, seed_t x) {
  stack_t stack;
  uint owner = NO_SEED;
  real least = REAL_MAX;
  push_root(&stack, tree);
  while (stack.depth > 0) {
    const uint node = stack.node[--stack.depth];
    const int level = stack.level[stack.depth], base = stack.depth;
    if (stack.key[base] >= least) continue;
    const uint end = level > 0 ? children_end(tree, node, level - 1) : min((node + 1) * TREE_FAN, tree.count);
    for (uint child = node * TREE_FAN; child < end; ++child) {
      if (level > 0) {
        const real key = node_distance(tree, tree.level_offset[level - 1] + child, x);
        if (key < least) push_sorted(&stack, base, child, level - 1, key);
        continue;
      }
      real q[DIMENSION];
      difference(tree.seeds[child], x, q);
      const real power = norm2(q) + weight_difference(x, tree.seeds[child]);
      if (power < least) {
        least = power;
        owner = child;
      }
    }
  }
  return owner;
}

/* owner[t]: a seed of least power in the middle of box t. */
__kernel void find_owners(const uint count, __global const seed_t* low, __global const seed_t* high,
                          __global uint* owner, __global const seed_t* seeds, const uint seed_count,
                          __global const seed_t* node_low, __global const seed_t* node_high,
                          __global const uint* level_offset, const int levels) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, seed_count};
  owner[t] = seed_of_least_power(tree, middle_of(low[t], high[t]));
}

/* Work-item t counts the pairs of rank t into offset[t] or, if `write`, lists them from offset[t] on, up to
   `capacity` in all. The tree of the regions: region_low and region_high are their boxes in curve order,
   region[] their numbers, group_low and group_high the nodes above. */
__kernel void find_pairs(const uint count, const int write, __global const uint* state,
                         __global const seed_t* seeds, __global const seed_t* node_low,
                         __global const seed_t* node_high, __global const uint* level_offset,
                         const int levels, const uint region_count, __global const uint* region,
                         __global const seed_t* region_low, __global const seed_t* region_high,
                         __global const seed_t* group_low, __global const seed_t* group_high,
                         __global const uint* group_offset, const int group_levels,
                         __global const uint* region_owner, __global const uint* group_owner,
                         __global const seed_t* corners, __global const uint* region_offset,
                         __global const uint* region_vertex, const ulong capacity, __global ulong* offset,
                         __global uint* pair_seed, __global uint* pair_region) {
  const uint i = (uint)get_global_id(0);
  if (i > count) return;
  if (i == count || state[i] != SEED_OK) {
    if (!write) offset[i] = 0;
    return;
  }
  const tree_t tree = {seeds, node_low, node_high, level_offset, levels, count};
  const tree_t groups = {region_low, group_low, group_high, group_offset, group_levels, region_count};
  const region_corners_t regions = {corners, region_offset, region_vertex};
  const seed_t seed = seeds[i];
  stack_t stack;
  testers_t testers;
  find_testers(tree, i, &stack, &testers);
  ulong at = write ? offset[i] : 0;
  push_root(&stack, groups);
  while (stack.depth > 0) {
    const uint node = stack.node[--stack.depth];
    const int level = stack.level[stack.depth];
    const uint group = group_offset[level] + node;
    bool owned = take_owner(&testers, tree, i, group_owner[group]);
    if (box_is_excluded(&testers, owned, seed, group_low[group], group_high[group])) continue;
    if (level > 0) {
      const uint end = children_end(groups, node, level - 1);
      for (uint child = node * TREE_FAN; child < end; ++child)
        push_sorted(&stack, stack.depth, child, level - 1, 0);
      continue;
    }
    const uint end = min((node + 1) * TREE_FAN, region_count);
    for (uint k = node * TREE_FAN; k < end; ++k) {
      owned = take_owner(&testers, tree, i, region_owner[k]);
      if (box_is_excluded(&testers, owned, seed, region_low[k], region_high[k]) ||
          region_is_excluded(&testers, owned, regions, region[k], seed))
        continue;
      if (write && at < capacity) {
        pair_seed[at] = i;
        pair_region[at] = region[k];
      }
      ++at;
    }
  }
  if (!write) offset[i] = at;
}
