/* Makes the images of the seeds within a margin: counts, lists, and puts them behind the seeds by rank. */
#include "periodic/shifts.cl"

/* Coordinates of seed i as integers; those along bounded axes do not count. */
static inline void load_place(__global const long* place, uint i, long* at) {
  UNROLL for (int c = 0; c < DIMENSION; ++c) at[c] = place[(size_t)i * DIMENSION + (size_t)c];
}

/* Work-item t counts the images of rank t into offset[t]. offset[count] becomes 0. */
__kernel void count_images(const uint count, __global const uint* order, __global const uint* state,
                           __global const long* place, __global const long* period,
                           __global const stored_real* extent, __global const stored_real* margin,
                           __global ulong* offset) {
  const uint t = (uint)get_global_id(0);
  if (t > count) return;
  offset[t] = 0;
  if (t == count || state[t] != SEED_OK) return;
  long at[DIMENSION];
  load_place(place, order[t], at);
  offset[t] = count_shifts(shifts_of(at, period, extent, margin[MARGIN_WIDTH])) - 1;
}

/* Work-item t lists the images of rank t from offset[t] on, as far as there is room: position and weight,
   rank of the seed, and number of the shift (shift_number: SHIFT_COUNT numbers). */
__kernel void list_images(const uint count, const uint room, __global const uint* order,
                          __global const uint* state, __global const seed_t* points,
                          __global const long* place, __global const long* period,
                          __global const stored_real* extent, __global const stored_real* margin,
                          __global const int* shift_number, __global const ulong* offset,
                          __global seed_t* image, __global uint* seed, __global int* number) {
  const uint t = (uint)get_global_id(0);
  if (t >= count || state[t] != SEED_OK) return;
  long at[DIMENSION], shift[DIMENSION];
  load_place(place, order[t], at);
  const shift_range_t range = shifts_of(at, period, extent, margin[MARGIN_WIDTH]);
  const uint images = count_shifts(range);
  parts_t p = parts_of(points[t]);
  ulong to = offset[t];
  for (uint k = 0; k < images; ++k) {
    uint rest = k;
    bool own = true;
    for (int v = DIMENSION - 1; v >= 0; --v) {
      const uint side = (uint)(range.high[v] - range.low[v] + 1);
      shift[v] = range.low[v] + (int)(rest % side);
      rest /= side;
      own = own && shift[v] == 0;
    }
    if (own) continue;
    if (to >= room) return;
    UNROLL for (int c = 0; c < DIMENSION; ++c) if (period[PERIOD_ROUNDED + c] != 0)
        place_to_frame(at[c] + sum_of_vectors(shift, period, c), period, c, &p.high[c], &p.low[c]);
    image[to] = seed_of(p);
    seed[to] = t;
    number[to++] = shift_number[place_of_shift(shift)];
  }
}

/* Work-item t: which of the places for images are taken, and those that are not as dead seeds. */
__kernel void mark_images(const uint room, const uint count, __global const ulong* offset,
                          __global uint* order, __global uint* status, __global seed_t* image) {
  const uint t = (uint)get_global_id(0);
  if (t >= room) return;
  order[t] = t;
  status[t] = t < offset[count] ? SEED_OK : SEED_INVALID;
  if (status[t] == SEED_OK) return;
  const parts_t nobody = {{0, 0, 0, DEAD_WEIGHT}, {0, 0, 0, 0}};
  image[t] = seed_of(nobody);
}

/* Work-item t writes rank t: one of the `count` seeds, or the image listed at order[t - count], whose seed
   and number go to place t - count. */
__kernel void place_images(const uint total, const uint count, __global const seed_t* points,
                           __global const uint* order, __global const seed_t* image,
                           __global const uint* seed, __global const int* number, __global seed_t* placed,
                           __global uint* image_seed, __global int* image_number) {
  const uint t = (uint)get_global_id(0);
  if (t >= total) return;
  if (t < count) {
    placed[t] = points[t];
    return;
  }
  const uint k = order[t - count];
  placed[t] = image[k];
  image_seed[t - count] = seed[k];
  image_number[t - count] = number[k];
}
