/* Cutting by the seeds of the near leaves (near.cl), nearest bisector first. */
#ifndef POWERCELL_NEIGHBORS_ORDER
#define POWERCELL_NEIGHBORS_ORDER
#include "neighbors/near.cl"

#define TAKEN (REAL_MAX / 4)

/* The seeds of the near leaves by key: the square of twice the signed distance of the bisector
   (docs/mathematics.md (4)), with its sign and tagged with the seed's place. */
typedef struct {
  real key[NEAR_MOST * LANES];
  real first[NEAR_MOST]; /* least key of each leaf */
  uint count;            /* leaves */
  __global const uint* leaf;
} order_t;

/* Which of eight seeds may cut the box [low, high] of the cell or lie in a side of it, over the corner that is
   worst (docs/mathematics.md (10)). A rounding margin is taken off. */
static inline mask8 seeds_may_cut(const real8* q, real8 dw, const real* low, const real* high) {
  real8 reach = ZERO8, q2 = ZERO8, size = size8(dw);
  for (int k = 0; k < DIMENSION; ++k) {
    reach = reach + most8(q[k] * all_lanes(low[k]), q[k] * all_lanes(high[k]));
    size = size + size8(q[k]) * all_lanes(2 * fmax(fabs(low[k]), fabs(high[k])));
    q2 = q2 + q[k] * q[k];
  }
  return reach + reach + (size + q2) * all_lanes(2 * 16 * REAL_EPSILON) > q2 + dw;
}

/* The key of eight seeds at q with weights less than that of the seed by dw. */
static inline real8 bisector_keys(const real8* q, real8 dw) {
  const real8 taken = all_lanes(TAKEN);
  real8 q2 = ZERO8;
  for (int c = 0; c < DIMENSION; ++c) q2 = q2 + q[c] * q[c];
  const real8 level = q2 + dw;
  return most8(least8(level * (size8(level) / q2), taken), -taken);
}

/* Keys of the seeds near i except itself. Where the region is no larger than what is near, seeds that its box
   excludes are left out. */
static inline void find_keys(order_t* order, const cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  const uint home = i / TREE_FAN;
  const origin_t origin = origin_of(tree.seeds[i]);
  real low[DIMENSION], high[DIMENSION];
  find_box(&cell->at, low, high);
  const bool small = find_radius2(&cell->at) < 4 * blocks.near_bound[home];
  order->count = blocks.near_count[home];
  order->leaf = blocks.near + (size_t)home * NEAR_MOST;
  for (uint k = 0; k < order->count; ++k) {
    const uint leaf = order->leaf[k];
    real8 q[DIMENSION], dw;
    seed_lanes(blocks, leaf, &origin, q, &dw);
    real8 key = bisector_keys(q, dw);
    if (small) key = choose8(all_lanes(TAKEN), key, seeds_may_cut(q, dw, low, high));
    if (leaf == home) key = with_lane(key, i % TREE_FAN, TAKEN);
    key = tag8(key, k * LANES);
    store8(key, order->key + k * LANES);
    order->first[k] = lane_least(key);
  }
  for (uint k = order->count; k % LANES != 0; ++k) order->first[k] = TAKEN;
}

/* Takes the least key; its tag is the seed's place, leaf in the list times LANES plus lane. */
static inline real take_least(order_t* order) {
  real8 best = load8(order->first);
  for (uint k = LANES; k < order->count; k += LANES) best = least8(best, load8(order->first + k));
  const real least = lane_least(best);
  const uint at = tag_of(least), leaf = at / LANES, row = leaf / LANES * LANES;
  const real8 rest = with_lane(load8(order->key + leaf * LANES), at % LANES, TAKEN);
  store8(rest, order->key + leaf * LANES);
  store8(with_lane(load8(order->first + row), leaf % LANES, lane_least(rest)), order->first + row);
  return least;
}

/* Cuts by the seeds of the near leaves except i. Returns a CUT code, CUT_NONE when done. */
static inline int cut_by_near(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  order_t order;
  const seed_t seed = tree.seeds[i];
  find_keys(&order, cell, tree, blocks, i);
  if (order.count == 0) return CUT_NONE;
  real reach = TAKEN / 2; /* found anew only after a bisector that cut nothing: that they end shows first there */
  bool shrunk = true;
  for (;;) {
    const real least = take_least(&order);
    if (!(untagged(least) < reach)) return CUT_NONE; /* that plane is beyond every vertex, and so are the rest */
    const uint at = tag_of(least), j = order.leaf[at / LANES] * TREE_FAN + at % LANES;
    const int cut = cut_by_seed(cell, seed, tree.seeds[j], (int)j);
    if (cut > CUT_SHRUNK) return cut;
    if (cut == CUT_NONE && shrunk) reach = 4 * find_radius2(&cell->at);
    shrunk = cut == CUT_SHRUNK;
  }
}

#endif
