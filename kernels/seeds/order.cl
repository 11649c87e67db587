/* Computes the sort keys of the seeds, and puts the seeds into their final order. */
#include "base/point.cl"
#include "seeds/hilbert.cl"

/* The grid of the curve: low corner, then cells per unit of length, a power of two. */
__kernel void make_grid(const uint tiles, __global const stored_real* boxes, __global stored_real* grid) {
  if (get_global_id(0) != 0) return;
  real side = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    real low = REAL_MAX, high = -REAL_MAX;
    for (uint t = 0; t < tiles; ++t) {
      low = fmin(low, boxes[(size_t)t * 2 * DIMENSION + (size_t)k]);
      high = fmax(high, boxes[(size_t)t * 2 * DIMENSION + DIMENSION + (size_t)k]);
    }
    grid[k] = low <= high ? low : 0; /* no valid seed, no box */
    if (low <= high) side = fmax(side, high - low);
  }
  const int exponent =
      side > 0 ? max(ilogb(side) + 1, LEAST_EXPONENT) : LEAST_EXPONENT; /* side < 2^exponent */
  grid[3] = ldexp((real)1, HILBERT_BITS - exponent);
}

/* The unit cell that contains high + low (>= 0). Leaves the remainder in *high, in cells of the next grid. */
static inline uint take_cell(real* high, real* low) {
  const real whole = floor(*high), rest = (*high - whole) + *low, more = floor(rest);
  const long most = ((long)1 << HILBERT_BITS) - 1;
  const long cell = (long)whole + (long)more;
  *high = (rest - more) * ((ulong)1 << HILBERT_BITS);
  *low = 0;
  return (uint)clamp(cell, (long)0, most);
}

static inline ulong curve_key(const parts_t* p, __global const stored_real* grid, bool fine) {
  uint cell[DIMENSION];
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    real low, high = exact_difference(p->high[k], grid[k], &low);
    low += p->low[k];
    high *= grid[3];
    low *= grid[3];
    cell[k] = take_cell(&high, &low);
    if (fine) cell[k] = take_cell(&high, &low);
  }
  return hilbert_key(cell);
}

/* A 32-bit hash of the position. */
static inline ulong position_hash(const parts_t* p) {
  ulong h = 0;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    h = (h ^ ordered_bits(p->high[k])) * (ulong)0x9e3779b97f4a7c15;
    h = (h ^ (h >> 29) ^ ordered_bits(p->low[k])) * (ulong)0xbf58476d1ce4e5b9;
    h ^= h >> 32;
  }
  return h & 0xffffffffu;
}

/* keys[t] of the seed order[t]: KEY_... of layout.h. Seeds that are not valid come last. */
__kernel void make_keys(const uint count, const int kind, __global const uint* order,
                        __global const seed_t* points, __global const uint* status,
                        __global const stored_real* grid, __global ulong* keys) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  const uint i = order[t];
  const parts_t p = parts_of(points[i]);
  ulong key = kind == KEY_COARSE ? (ulong)1 << 63 : 0;
  if (status[i] == SEED_OK) {
    if (kind == KEY_WEIGHT) {
      const ulong middle = (ulong)1 << (WEIGHT_KEY_BITS - 1);
      key = (middle - 1) + middle - ordered_bits(p.high[3]);
    } else if (kind == KEY_HASH) {
      key = position_hash(&p);
    } else {
      key = curve_key(&p, grid, kind == KEY_FINE);
    }
  }
  keys[t] = key;
}

__kernel void number_seeds(const uint count, __global uint* order) {
  const uint i = (uint)get_global_id(0);
  if (i < count) order[i] = i;
}

#define NO_SEED 0xffffffffu

/* The last seed before rank t at the same position, or NO_SEED. Sorting has put the seeds of one position
   side by side, the one to keep first; only other positions with the same hash may lie between. */
static inline uint seed_before(uint t, const parts_t* p, __global const uint* order,
                               __global const seed_t* points) {
  const ulong hash = position_hash(p);
  for (uint k = t; k > 0; --k) {
    const parts_t before = parts_of(points[order[k - 1]]);
    if (same_position(&before, p)) return order[k - 1];
    if (position_hash(&before) != hash) return NO_SEED;
  }
  return NO_SEED;
}

/* Whether seed i is a duplicate of seed `kept` in the numbers that the host has too, which have a larger
   range or more digits: in those of `place` if `wrapped` (wrap.cl), else in the caller's. */
static inline bool is_duplicate(uint i, uint kept, __global const stored_real* positions,
                                __global const stored_real* weights, int weighted, int wrapped,
                                __global const long* place) {
  for (size_t k = 0; k < DIMENSION; ++k) {
    const size_t a = (size_t)i * DIMENSION + k, b = (size_t)kept * DIMENSION + k;
    if (wrapped ? place[a] != place[b] : positions[a] != positions[b]) return false;
  }
  if (!weighted || weights[i] == weights[kept]) return kept < i;
  return weights[i] < weights[kept];
}

/* Writes the seeds by rank, and their state: SEED_OK, _DUPLICATE, _MERGED or _INVALID. */
__kernel void place_seeds(const uint count, __global const uint* order, __global const seed_t* points,
                          __global const uint* status, __global const stored_real* positions,
                          __global const stored_real* weights, const int weighted, const int wrapped,
                          __global const long* place, __global seed_t* placed, __global uint* state) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  const uint i = order[t];
  parts_t p = parts_of(points[i]);
  uint result = status[i];
  if (result == SEED_OK) {
    const uint kept = seed_before(t, &p, order, points);
    if (kept != NO_SEED)
      result =
          is_duplicate(i, kept, positions, weights, weighted, wrapped, place) ? SEED_DUPLICATE : SEED_MERGED;
  }
  if (result != SEED_OK) {
    p.high[3] = DEAD_WEIGHT;
    p.low[3] = 0;
  }
  placed[t] = seed_of(p);
  state[t] = result;
}
