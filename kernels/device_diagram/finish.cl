/* From the moments of the pairs to the measures of the seeds, in the caller's order and units. */
#include "base/real.cl"

#define MEASURES (2 + DIMENSION)

/* Pieces that rounding may have decided count as they are. */
static inline bool is_finished(uint status) {
  const uint piece = status & ~(uint)PIECE_UNCERTAIN;
  return piece == PIECE_DONE || piece == PIECE_EMPTY || piece == PIECE_FLAT;
}

/* Sums over the pairs of rank t, in their order, and tells whether rounding may have decided any of them.
   Returns the status of the seed. */
static inline uint sum_pairs(uint t, __global const ulong* offset, ulong capacity,
                             __global const uint* pair_status, __global const stored_real* moments, real* sum,
                             bool* uncertain) {
  for (int k = 0; k < MEASURES; ++k) sum[k] = 0;
  if (offset[t + 1] > capacity) return SEED_UNFINISHED;
  for (ulong pair = offset[t]; pair < offset[t + 1]; ++pair) {
    if (!is_finished(pair_status[pair])) return SEED_UNFINISHED;
    *uncertain = *uncertain || (pair_status[pair] & PIECE_UNCERTAIN) != 0;
    for (int k = 0; k < MEASURES; ++k) sum[k] += moments[pair * MEASURES + (ulong)k];
  }
  return sum[0] > 0 ? SEED_OK : SEED_HIDDEN;
}

/* Writes row order[t] of measures (mass, centroid, second moment), of status, and of for_host, which is 1
   where only the host can decide the cell, for rank t. */
__kernel void write_measures(const uint count, __global const uint* order, __global const uint* state,
                             __global const ulong* offset, const ulong capacity,
                             __global const uint* pair_status, __global const stored_real* moments,
                             __global const stored_real* frame, __global const stored_real* positions,
                             __global stored_real* measures, __global uint* status, __global uint* for_host) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  const size_t i = order[t];
  const real unit = frame[FRAME_UNIT];
  real sum[MEASURES];
  uint result = state[t];
  bool uncertain = result == SEED_MERGED;
  if (uncertain) result = SEED_DUPLICATE;
  if (result == SEED_OK) result = sum_pairs(t, offset, capacity, pair_status, moments, sum, &uncertain);

  const bool known = result != SEED_INVALID && result != SEED_UNFINISHED, cell = result == SEED_OK;
  real scale = unit;
  for (int k = 1; k < CELL_DIMENSION; ++k) scale *= unit;
  __global stored_real* row = measures + i * MEASURES;
  row[0] = cell ? sum[0] * scale : known ? (real)0 : (real)NAN;
  UNROLL for (int k = 0; k < DIMENSION; ++k) row[1 + k] =
      cell ? positions[i * DIMENSION + (size_t)k] + sum[1 + k] / sum[0] * unit : (real)NAN;
  row[1 + DIMENSION] = cell ? sum[1 + DIMENSION] * scale * unit * unit : known ? (real)0 : (real)NAN;
  status[i] = result;
  for_host[i] = uncertain || result == SEED_UNFINISHED ? 1u : 0u;
}

/* Puts the integrals of a density in place of the measures of the cells that are there, for rank t. A mass
   that rounding has made negative is 0, and where it is 0 there is no centroid. */
__kernel void write_density(const uint count, __global const uint* order, __global const uint* status,
                            __global const ulong* offset, __global const stored_real* moments,
                            __global const stored_real* frame, __global const stored_real* positions,
                            __global stored_real* measures) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  const size_t i = order[t];
  if (status[i] != SEED_OK) return;
  const real unit = frame[FRAME_UNIT];
  real sum[MEASURES], scale = unit;
  for (int k = 0; k < MEASURES; ++k) sum[k] = 0;
  for (ulong pair = offset[t]; pair < offset[t + 1]; ++pair)
    for (int k = 0; k < MEASURES; ++k) sum[k] += moments[pair * MEASURES + (ulong)k];
  for (int k = 1; k < CELL_DIMENSION; ++k) scale *= unit;
  const bool negative = sum[0] < 0 || sum[1 + DIMENSION] < 0;
  __global stored_real* row = measures + i * MEASURES;
  row[0] = sum[0] < 0 ? (real)0 : sum[0] * scale;
  UNROLL for (int k = 0; k < DIMENSION; ++k) row[1 + k] =
      sum[0] > 0 ? positions[i * DIMENSION + (size_t)k] + sum[1 + k] / sum[0] * unit : (real)NAN;
  row[1 + DIMENSION] = negative ? (real)0 : sum[1 + DIMENSION] * scale * unit * unit;
}
