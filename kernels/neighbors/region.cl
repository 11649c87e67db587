/* Clips a cell by the listed seeds that can meet its region. No other seed has a point of the region, so no
   search is needed (docs/mathematics.md, "Which seeds meet a region"). */
#ifndef POWERCELL_NEIGHBORS_REGION
#define POWERCELL_NEIGHBORS_REGION
#include "base/lanes.cl"
#include "neighbors/exclude.cl"

#define LISTED_SEEDS 96 /* most seeds of a list */
#define FEW_LISTED 16   /* lists up to this length are not ordered: that would take longer than it saves */
#define LISTED_LAST (REAL_MAX / 4) /* key of a seed that has been tried */

typedef struct {
  __global const seed_t* seeds; /* by rank */
  __global const ulong* offset; /* per region: its list; a region without a list has an empty one */
  __global const uint* seed;    /* ranks */
} region_lists_t;

static inline bool region_has_list(region_lists_t lists, uint region) {
  return lists.offset[region] < lists.offset[region + 1];
}

/* Twice the largest distance of a vertex of the cell from `centre`. */
static inline real cell_reach(const cell_t* cell, const real* centre) {
  reals most = ZERO;
  for (int v = 0; v < slots_of(&cell->at); v += LANE_WIDTH) {
    reals r2 = ZERO;
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      const reals t = load_lanes(cell->at.x[k] + v) - all_lanes(centre[k]);
      r2 = r2 + t * t;
    }
    most = each_most(most, choose(ZERO, r2, used_lanes(&cell->at, v)));
  }
  return 2 * sqrt(lane_most(most)) * (1 + SEARCH_MARGIN);
}

/* The point whose distance orders the cuts: the seed, or the middle of the region if the seed is farther from
   it than the region's vertices are. Returns cell_reach. */
static inline real cell_centre(cell_t* cell, real* centre) {
  real c2 = 0;
  find_box(&cell->at);
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    centre[k] = (cell->at.low[k] + cell->at.high[k]) / 2;
    c2 += centre[k] * centre[k];
  }
  const real reach = cell_reach(cell, centre);
  if (4 * c2 > reach * reach) return reach;
  UNROLL for (int k = 0; k < DIMENSION; ++k) centre[k] = 0;
  return cell_reach(cell, centre);
}

/* Keys of the listed seeds, tagged with their places: twice the signed distance of the bisector from the
   centre, erring on the low side. Returns the number of keys, a multiple of LANES. */
static inline int find_list_keys(const cell_t* cell, region_lists_t lists, uint i, uint region,
                                 const real* centre, real* key) {
  const ulong begin = lists.offset[region];
  const int count = (int)(lists.offset[region + 1] - begin), rows = (count + LANES - 1) / LANES;
  const seed_t seed = lists.seeds[i];
  const real resolution = resolution_of(&cell->at);
  for (int k = 0; k < rows * LANES; ++k) {
    const uint j = lists.seed[begin + (ulong)min(k, count - 1)];
    real q[DIMENSION], along = 0, sum = 0;
    difference(lists.seeds[j], seed, q);
    UNROLL for (int c = 0; c < DIMENSION; ++c) {
      along += q[c] * centre[c];
      sum += fabs(q[c]);
    }
    const real q2 = norm2(q), dw = weight_difference(seed, lists.seeds[j]);
    const real offset = q2 + dw - 2 * along - plane_error(&cell->at, sum, q2, dw);
    key[k] = k >= count || j == i ? LISTED_LAST : offset / most_of(sqrt(q2), resolution);
  }
  for (int k = 0; k < rows * LANES; k += LANE_WIDTH)
    store_lanes(tag(each_least(load_lanes(key + k), all_lanes(LISTED_LAST)), (uint)k), key + k);
  return rows * LANES;
}

/* Clips the cell of rank i by all of `count` seeds, in their order. Returns a PIECE status. */
static inline int clip_by_listed(cell_t* cell, region_lists_t lists, uint i, __global const uint* listed,
                                 int count) {
  for (int k = 0; k < count; ++k) {
    const uint j = listed[k];
    if (j == i) continue;
    const int cut = cut_by_seed(cell, (int)j);
    if (cut > CUT_SHRUNK) return piece_status(cut);
  }
  return PIECE_DONE;
}

/* The same in the order of the keys, for longer lists. */
static inline int clip_in_order(cell_t* cell, region_lists_t lists, uint i, uint region) {
  real key[LISTED_SEEDS] FOR_LANES, centre[DIMENSION], reach = cell_centre(cell, centre);
  const int keys = find_list_keys(cell, lists, i, region, centre, key);
  for (;;) {
    reals best = load_lanes(key);
    for (int k = LANE_WIDTH; k < keys; k += LANE_WIDTH) best = each_least(best, load_lanes(key + k));
    const real least = lane_least(best);
    if (!(untagged(least) < reach)) { /* this plane and all later ones clear every vertex */
      cell->at.gap = fmin(cell->at.gap, SEARCH_MARGIN / 8 * reach);
      return PIECE_DONE;
    }
    const uint at = tag_of(least), row = at / LANE_WIDTH * LANE_WIDTH;
    store_lanes(with_lane(load_lanes(key + row), at - row, LISTED_LAST), key + row);
    const uint j = lists.seed[lists.offset[region] + at];
    const int cut = cut_by_seed(cell, (int)j);
    if (cut == CUT_SHRUNK) reach = cell_reach(cell, centre);
    if (cut > CUT_SHRUNK) return piece_status(cut);
  }
}

/* Clips the cell of rank i in `region` by the seeds in its list. Returns a PIECE status. */
static inline int clip_by_region(cell_t* cell, regions_t regions, region_lists_t lists, uint i, uint region) {
  const int start = cell_start(cell, regions, lists.seeds, i, region, REAL_MAX);
  if (start != PIECE_DONE) return start;
  const ulong begin = lists.offset[region];
  const int count = (int)(lists.offset[region + 1] - begin);
  return count <= FEW_LISTED ? clip_by_listed(cell, lists, i, lists.seed + begin, count)
                             : clip_in_order(cell, lists, i, region);
}

#endif
