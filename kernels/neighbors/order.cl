/* Cuts a cell by the seeds of the near leaves (near.cl), nearest bisector first (docs/mathematics.md (4)). */
#ifndef POWERCELL_NEIGHBORS_ORDER
#define POWERCELL_NEIGHBORS_ORDER
#include "neighbors/exclude.cl"
#include "neighbors/near.cl"

#define TAKEN (REAL_MAX / 4)
/* After so many bisectors that cut nothing, the rest are tested leaf by leaf. White noise has some 24. */
#define MISSES_MOST 64

/* The seeds of the near leaves by key: the square of twice the signed distance of the bisector
   (docs/mathematics.md (4)), with its sign and tagged with the seed's place, leaf in the list times LANES
   plus lane. Seeds that are taken have the key TAKEN. One lane at a time, keys are computed again when they
   are needed: to keep them would take more private memory than the cell. */
typedef struct {
#if LANE_WIDTH == 1
  uchar left[NEAR_MOST]; /* a bit for each seed that is not taken */
#else
  real key[NEAR_MOST * LANES] FOR_LANES;
#endif
  real first[NEAR_MOST] FOR_LANES; /* least key of each leaf */
  uint count;                      /* leaves */
  __global const uint* leaf;
} order_t;

/* Keys of seeds at q, whose weights are less than the cell's own by dw. Where squares and weights
   cancel, and for seeds nearer than the resolution, keys err on the low side. */
static inline reals bisector_keys(const reals* q, reals dw, real resolution) {
  const reals taken = all_lanes(TAKEN);
  reals q2 = ZERO;
  UNROLL for (int c = 0; c < DIMENSION; ++c) q2 = q2 + q[c] * q[c];
  const reals offset = q2 * all_lanes(1 - 16 * REAL_EPSILON) + dw;
  return each_most(
      each_least(offset * (each_size(offset) / each_most(q2, all_lanes(resolution * resolution))), taken),
      -taken);
}

#if LANE_WIDTH == 1
/* Notes the key of the seed of place `at`; places come in order. */
static inline void note_keys(order_t* order, uint at, real key) {
  const uint before = at % LANES == 0 ? 0 : order->left[at / LANES];
  order->left[at / LANES] = (uchar)(before | (key < TAKEN / 2 ? 1u << at % LANES : 0));
}

/* The key of the seed of place `at`, which is not taken. */
static inline real key_again(const order_t* order, const vertices_t* p, blocks_t blocks, uint at) {
  const origin_t origin = search_origin(p->seeds[p->self]);
  real q[DIMENSION], dw;
  seed_lanes(blocks, order->leaf[at / LANES], at % LANES, &origin, q, &dw);
  return tag(bisector_keys(q, dw, resolution_of(p)), at);
}

/* Takes the seed of place `at`. Returns the least key left in its leaf, TAKEN with a place there if none is:
   from elsewhere nothing could be taken later. */
static inline real take_seed(order_t* order, const vertices_t* p, blocks_t blocks, uint at) {
  const uint leaf = at / LANES;
  uint bits = order->left[leaf] & ~(1u << at % LANES);
  real least = tag(TAKEN, leaf * LANES);
  order->left[leaf] = (uchar)bits;
  for (; bits != 0; bits &= bits - 1)
    least = least_of(key_again(order, p, blocks, leaf * LANES + (uint)lowest_bit(bits)), least);
  return least;
}

/* The seeds of leaf k with keys below `reach`. */
static inline uint seeds_below(const order_t* order, const vertices_t* p, blocks_t blocks, uint k,
                               real reach) {
  uint below = 0;
  for (uint bits = order->left[k]; bits != 0; bits &= bits - 1) {
    const uint lane = (uint)lowest_bit(bits);
    if (key_again(order, p, blocks, k * LANES + lane) < reach) below |= 1u << lane;
  }
  return below;
}
#else
static inline void note_keys(order_t* order, uint at, reals key) {
  store_lanes(key, order->key + at);
}

static inline real take_seed(order_t* order, const vertices_t* p, blocks_t blocks, uint at) {
  real* leaf = order->key + at / LANES * LANES;
  real least = REAL_MAX;
  (void)p;
  (void)blocks;
  EACH_LANE(lane) {
    const reals rest = with_lane(load_lanes(leaf + lane), at % LANES - lane, TAKEN);
    store_lanes(rest, leaf + lane);
    least = least_of(lane_least(rest), least);
  }
  return least;
}

static inline uint seeds_below(const order_t* order, const vertices_t* p, blocks_t blocks, uint k,
                               real reach) {
  uint below = 0;
  (void)p;
  (void)blocks;
  EACH_LANE(lane) below |= lane_bits(load_lanes(order->key + k * LANES + lane) < all_lanes(reach)) << lane;
  return below;
}
#endif

/* Computes the keys of the seeds near i except i. Where the region is no larger than the near leaves reach,
   seeds that cannot cut its box are left out. */
static inline void find_keys(order_t* order, cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  const uint home = i / TREE_FAN;
  order->count = blocks.near_count[home];
  if (order->count == 0) return;
  order->leaf = blocks.near + (size_t)home * NEAR_MOST;
  const origin_t origin = search_origin(tree.seeds[i]);
  const real resolution = resolution_of(&cell->at);
  const bool small = find_radius2(&cell->at) < 4 * blocks.near_bound[home];
  if (small) find_box(&cell->at);
  for (uint k = 0; k < order->count; ++k) {
    const uint leaf = order->leaf[k];
    real first = REAL_MAX;
    EACH_LANE(lane) {
      reals q[DIMENSION], dw;
      seed_lanes(blocks, leaf, lane, &origin, q, &dw);
      reals key = bisector_keys(q, dw, resolution);
      if (small) key = choose(all_lanes(TAKEN), key, seeds_may_cut(&cell->at, q, dw));
      if (leaf == home) key = with_lane(key, i % TREE_FAN - lane, TAKEN);
      key = tag(key, k * LANES + lane);
      note_keys(order, k * LANES + lane, key);
      first = least_of(lane_least(key), first);
    }
    order->first[k] = first;
  }
  for (uint k = order->count; k % LANE_WIDTH != 0; ++k) order->first[k] = TAKEN;
}

/* Takes the seed of the least key, which is returned. */
static inline real take_least(order_t* order, const vertices_t* p, blocks_t blocks) {
  reals best = load_lanes(order->first);
  for (uint k = LANE_WIDTH; k < order->count; k += LANE_WIDTH)
    best = each_least(best, load_lanes(order->first + k));
  const real least = lane_least(best);
  const uint at = tag_of(least), leaf = at / LANES, row = leaf / LANE_WIDTH * LANE_WIDTH;
  const real rest = take_seed(order, p, blocks, at);
  store_lanes(with_lane(load_lanes(order->first + row), leaf - row, rest), order->first + row);
  return least;
}

/* Cuts by the seeds of a leaf whose bits are set in `left`, after a test by the vertices if `close`, else by
   the box of the cell, which is kept up to date. Returns a CUT code; when done, minus the number of seeds
   that cut nothing. */
static inline int cut_by_leaf(cell_t* cell, blocks_t blocks, uint leaf, uint left, bool close) {
  int misses = 0;
  EACH_LANE(lane) {
    uint bits = left >> lane & ((1u << LANE_WIDTH) - 1);
    if (bits == 0) continue;
    const origin_t origin = search_origin(cell->at.seeds[cell->at.self]);
    reals q[DIMENSION], dw;
    seed_lanes(blocks, leaf, lane, &origin, q, &dw);
    while (bits != 0) {
      bits &= lane_bits(close ? seeds_cut(&cell->at, q, dw) : seeds_may_cut(&cell->at, q, dw));
      int cut = CUT_NONE;
      while (bits != 0 && cut != CUT_SHRUNK) {
        const uint j = leaf * TREE_FAN + lane + (uint)lowest_bit(bits);
        bits &= bits - 1;
        cut = cut_by_seed(cell, (int)j);
        if (cut > CUT_SHRUNK) return cut;
        misses += cut == CUT_NONE;
      }
      if (cut != CUT_SHRUNK) break;
      if (!close) find_box(&cell->at);
    }
  }
  return -misses;
}

/* Cuts by the seeds that are left in the order, leaf by leaf. Returns a CUT code, CUT_NONE when done. */
static inline int cut_by_left(cell_t* cell, const order_t* order, blocks_t blocks) {
  const real reach = 4 * (1 + SEARCH_MARGIN / 4) * find_radius2(&cell->at);
  for (uint k = 0; k < order->count; ++k) {
    if (!(order->first[k] < reach)) continue;
    const uint left = seeds_below(order, &cell->at, blocks, k, reach);
    const int cut = cut_by_leaf(cell, blocks, order->leaf[k], left, true);
    if (cut > CUT_SHRUNK) return cut;
  }
  return CUT_NONE;
}

/* Cuts by the seeds of the near leaves except i. Returns a CUT code, CUT_NONE when done. */
static inline int cut_by_near(cell_t* cell, tree_t tree, blocks_t blocks, uint i) {
  order_t order;
  find_keys(&order, cell, tree, blocks, i);
  if (order.count == 0) return CUT_NONE;
  /* (2R)^2, R being the radius of the cell. Updated only after a bisector that cut nothing: once the cell is
     done, such a bisector comes first. */
  real reach = TAKEN / 2;
  bool shrunk = true;
  for (int misses = 0; misses < MISSES_MOST;) {
    const real least = take_least(&order, &cell->at, blocks);
    if (!(untagged(least) < reach)) return CUT_NONE; /* this plane and all later ones clear every vertex */
    const uint at = tag_of(least), j = order.leaf[at / LANES] * TREE_FAN + at % LANES;
    const int cut = cut_by_seed(cell, (int)j);
    if (cut > CUT_SHRUNK) return cut;
    if (cut == CUT_NONE && shrunk) reach = 4 * (1 + SEARCH_MARGIN / 4) * find_radius2(&cell->at);
    shrunk = cut == CUT_SHRUNK;
    misses += cut == CUT_NONE;
  }
  return cut_by_left(cell, &order, blocks);
}

#endif
