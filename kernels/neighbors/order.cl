/* Cuts a cell by the seeds of the near leaves (near.cl), nearest bisector first (docs/mathematics.md (4)). */
#ifndef POWERCELL_NEIGHBORS_ORDER
#define POWERCELL_NEIGHBORS_ORDER
#include "neighbors/exclude.cl"
#include "neighbors/near.cl"

#define TAKEN (REAL_MAX / 4)
/* After so many bisectors that cut nothing, the rest are tested eight at a time. White noise has some 24. */
#define MISSES_MOST 64

/* The seeds of the near leaves by key: the square of twice the signed distance of the bisector
   (docs/mathematics.md (4)), with its sign and tagged with the seed's place. */
typedef struct {
  real key[NEAR_MOST * LANES];
  real first[NEAR_MOST]; /* least key of each leaf */
  uint count;            /* leaves */
  __global const uint* leaf;
} order_t;

/* Keys of eight seeds at q, whose weights are less than the cell's own by dw. Where squares and weights
   cancel, and for seeds nearer than the resolution, keys err on the low side. */
static inline real8 bisector_keys(const real8* q, real8 dw, real resolution) {
  const real8 taken = all_lanes(TAKEN);
  real8 q2 = ZERO8;
  UNROLL for (int c = 0; c < DIMENSION; ++c) q2 = q2 + q[c] * q[c];
  const real8 offset = q2 * all_lanes(1 - 16 * REAL_EPSILON) + dw;
  return most8(least8(offset * (size8(offset) / most8(q2, all_lanes(resolution * resolution))), taken),
               -taken);
}

/* Computes the keys of the seeds near i except i. Where the region is no larger than the near leaves reach,
   seeds that cannot cut its box are left out. */
static inline void find_keys(order_t* order, cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  const uint home = i / TREE_FAN;
  order->count = blocks.near_count[home];
  if (order->count == 0) return;
  order->leaf = blocks.near + (size_t)home * NEAR_MOST;
  const origin_t origin = search_origin(tree.seeds[i]);
  const real resolution = resolution_of(&cell->at);
  real low[DIMENSION], high[DIMENSION];
  const bool small = find_radius2(&cell->at) < 4 * blocks.near_bound[home];
  if (small) find_box(&cell->at, low, high);
  for (uint k = 0; k < order->count; ++k) {
    const uint leaf = order->leaf[k];
    real8 q[DIMENSION], dw;
    seed_lanes(blocks, leaf, &origin, q, &dw);
    real8 key = bisector_keys(q, dw, resolution);
    if (small) key = choose8(all_lanes(TAKEN), key, seeds_may_cut(q, dw, resolution, low, high));
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

/* Cuts by the seeds of a leaf whose bits are set in `left`, after a test by the vertices if `close`, else by
   the box [low, high] of the cell, which is kept up to date. Returns a CUT code, CUT_NONE when done. */
static inline int cut_by_leaf(cell_t* cell, tree_t tree, blocks_t blocks, uint i, uint leaf, uint left,
                              bool close, real* low, real* high) {
  const seed_t seed = tree.seeds[i];
  const origin_t origin = search_origin(seed);
  const real resolution = resolution_of(&cell->at);
  real8 q[DIMENSION], dw;
  seed_lanes(blocks, leaf, &origin, q, &dw);
  for (;;) {
    left &= lane_bits(close ? seeds_cut(&cell->at, q, dw) : seeds_may_cut(q, dw, resolution, low, high));
    int cut = CUT_NONE;
    while (left != 0 && cut != CUT_SHRUNK) {
      const uint j = leaf * TREE_FAN + (uint)lowest_bit(left);
      left &= left - 1;
      cut = cut_by_seed(cell, seed, tree.seeds[j], (int)j);
      if (cut > CUT_SHRUNK) return cut;
    }
    if (cut != CUT_SHRUNK) return CUT_NONE;
    if (!close) find_box(&cell->at, low, high);
  }
}

/* Cuts by the seeds that are left in the order, leaf by leaf. Returns a CUT code, CUT_NONE when done. */
static inline int cut_by_left(cell_t* cell, const order_t* order, tree_t tree, blocks_t blocks, uint i) {
  const real reach = 4 * (1 + SEARCH_MARGIN / 4) * find_radius2(&cell->at);
  real none[DIMENSION];
  for (uint k = 0; k < order->count; ++k) {
    if (!(order->first[k] < reach)) continue;
    const uint left = lane_bits(load8(order->key + k * LANES) < all_lanes(reach));
    const int cut = cut_by_leaf(cell, tree, blocks, i, order->leaf[k], left, true, none, none);
    if (cut > CUT_SHRUNK) return cut;
  }
  return CUT_NONE;
}

/* Cuts by the seeds of the near leaves except i. Returns a CUT code, CUT_NONE when done. */
static inline int cut_by_near(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  order_t order;
  const seed_t seed = tree.seeds[i];
  find_keys(&order, cell, tree, blocks, i);
  if (order.count == 0) return CUT_NONE;
  /* (2R)^2, R being the radius of the cell. Updated only after a bisector that cut nothing: once the cell is
     done, such a bisector comes first. */
  real reach = TAKEN / 2;
  bool shrunk = true;
  for (int misses = 0; misses < MISSES_MOST;) {
    const real least = take_least(&order);
    if (!(untagged(least) < reach)) return CUT_NONE; /* this plane and all later ones clear every vertex */
    const uint at = tag_of(least), j = order.leaf[at / LANES] * TREE_FAN + at % LANES;
    const int cut = cut_by_seed(cell, seed, tree.seeds[j], (int)j);
    if (cut > CUT_SHRUNK) return cut;
    if (cut == CUT_NONE && shrunk) reach = 4 * (1 + SEARCH_MARGIN / 4) * find_radius2(&cell->at);
    shrunk = cut == CUT_SHRUNK;
    misses += cut == CUT_NONE;
  }
  return cut_by_left(cell, &order, tree, blocks, i);
}

#endif
