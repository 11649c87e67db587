/* Proves that no image that was not made cuts a cell (docs/mathematics.md (34b)). */
#include "periodic/shifts.cl"

/* Of a proved reach, relative (82); more than the rounding of the distances compared. */
#define REACH_FACTOR ((1 + SEARCH_MARGIN) * (1 + (real)1e-6))

/* Whether a seed at `at` is so far from the border of the margin, along all vectors. */
static inline bool is_clear(real clear, const long* at, __global const long* period,
                            __global const stored_real* extent, real margin) {
  bool all = true;
  UNROLL for (int k = 0; k < DIMENSION; ++k) {
    if (k >= period[PERIOD_COUNT] || is_complete(extent, margin, k)) continue;
    const long bits = period[PERIOD_BITS + k] + PERIOD_FINE;
    const real x = (real)scaled(fraction_along(at, period, k), MARGIN_BITS - bits) / (1 << MARGIN_BITS);
    all = all && clear <= margin + fmin(x, 1 - x) * extent[EXTENT_SPACING + k];
  }
  return all;
}

/* Pair t is that of rank t with the only region. Cells of which the proof fails become PIECE_MORE; where not
   all images had room, all cells. Empty ones remain empty among more images. */
__kernel void prove_reach(const uint count, const uint room, __global const ulong* offset,
                          __global const uint* order, __global const seed_t* points,
                          __global const long* place, __global const long* period,
                          __global const stored_real* extent, __global const stored_real* margin,
                          __global const stored_real* reach, __global uint* status) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  const uint piece = status[t] & ~(uint)PIECE_UNCERTAIN;
  if (piece != PIECE_DONE && piece != PIECE_FLAT) return;
  long at[DIMENSION];
  UNROLL for (int c = 0; c < DIMENSION; ++c) at[c] = place[(size_t)order[t] * DIMENSION + (size_t)c];
  const real r = reach[t], excess = margin[MARGIN_WEIGHT] - parts_of(points[t]).high[3];
  const real clear = REACH_FACTOR * (r + sqrt(r * r + fmax(excess, (real)0)));
  if (offset[count] > room || !is_clear(clear, at, period, extent, margin[MARGIN_WIDTH]))
    status[t] = PIECE_MORE;
}
