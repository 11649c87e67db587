/* From the caller's seeds to points in the device's frame. */
#ifndef POWERCELL_SEEDS_FRAME
#define POWERCELL_SEEDS_FRAME
#include "base/point.cl"

/* Coordinate x of axis k in the frame, as high + low. */
static inline void to_frame(__global const stored_real* frame, real x, int k, real* high, real* low) {
  *high = exact_difference(x, frame[FRAME_CENTRE + k], low);
  *low -= frame[FRAME_CENTRE_LOW + k];
  normalize_parts(high, low);
  *high *= frame[FRAME_SCALE];
  *low *= frame[FRAME_SCALE];
}

/* Writes seed i at p with weight i of `weights` (not read unless `weighted`), and its status: SEED_OK, or
   SEED_INVALID with a finite stand-in for the point. */
static inline void write_seed(uint i, parts_t p, bool valid, __global const stored_real* frame,
                              __global const stored_real* weights, int weighted, __global seed_t* points,
                              __global uint* status) {
  if (weighted) {
    p.high[3] = weights[i] * frame[FRAME_SCALE] * frame[FRAME_SCALE];
    valid = valid && fabs(p.high[3]) <= MOST_WEIGHT;
  }
  if (!valid) {
    for (int k = 0; k < 4; ++k) p.high[k] = p.low[k] = 0;
    p.high[3] = DEAD_WEIGHT;
  }
  points[i] = seed_of(p);
  status[i] = valid ? SEED_OK : SEED_INVALID;
}

#endif
