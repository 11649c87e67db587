/* Transforms the caller's seeds to the device's frame, and finds the box around them. */
#include "seeds/frame.cl"

/* positions: count x DIMENSION, weights: count (not read unless `weighted`). Writes points and their
   status: SEED_OK or SEED_INVALID, with a finite stand-in for the point. */
__kernel void pack_seeds(const uint count, __global const stored_real* frame,
                         __global const stored_real* positions, __global const stored_real* weights,
                         const int weighted, __global seed_t* points, __global uint* status) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  parts_t p = {{0, 0, 0, 0}, {0, 0, 0, 0}};
  bool valid = true;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    to_frame(frame, positions[(size_t)i * DIMENSION + (size_t)k], k, &p.high[k], &p.low[k]);
    valid = valid && fabs(p.high[k]) <= MOST_COORDINATE;
  }
  write_seed(i, p, valid, frame, weights, weighted, points, status);
}

/* Box of the valid seeds of tile t: rows of DIMENSION lows and DIMENSION highs. */
__kernel void box_of_tiles(const uint tiles, const uint tile, const uint count, __global const seed_t* points,
                           __global const uint* status, __global stored_real* boxes) {
  const uint t = (uint)get_global_id(0);
  if (t >= tiles) return;
  real low[DIMENSION], high[DIMENSION];
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    low[k] = REAL_MAX;
    high[k] = -REAL_MAX;
  }
  const uint begin = t * tile, end = begin + min(tile, count - begin);
  for (uint i = begin; i < end; ++i) {
    if (status[i] != SEED_OK) continue;
    const parts_t p = parts_of(points[i]);
    UNROLL for (int k = 0; k < DIMENSION; ++k) {
      low[k] = fmin(low[k], p.high[k]);
      high[k] = fmax(high[k], p.high[k]);
    }
  }
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    boxes[(size_t)t * 2 * DIMENSION + (size_t)k] = low[k];
    boxes[(size_t)t * 2 * DIMENSION + DIMENSION + (size_t)k] = high[k];
  }
}
