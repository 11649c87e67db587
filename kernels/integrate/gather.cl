/* Sums the moments of the pairs of each seed, in the order of the pairs, so that the result has the
   same bits whatever the chunks and work-groups. */
#include "base/real.cl"

#define MOMENTS (2 + DIMENSION)

/* The loop ends early if the sum is NaN, which changes no result but keeps this order: Intel's compiler
   reorders loops that are plain sums where it does not vectorise over work-items. */
static inline stored_real add_column(stored_real sum, __global const stored_real* moments, uint first,
                                     uint end, uint column) {
  for (uint pair = first; pair < end && sum == sum; ++pair) sum += moments[(size_t)pair * MOMENTS + column];
  return sum;
}

/* Work-item t adds the pairs offset[t] .. offset[t+1] of the chunk into row t of `sums`. If
   `goes_on`, row 0 starts from the sum `before` that the previous chunk has left for the same seed. */
__kernel void gather(const uint count, __global const uint* offset, const int goes_on,
                     __global const stored_real* before, __global const stored_real* moments,
                     __global stored_real* sums) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  for (uint k = 0; k < MOMENTS; ++k)
    sums[(size_t)t * MOMENTS + k] =
        add_column(t == 0 && goes_on ? before[k] : (stored_real)0, moments, offset[t], offset[t + 1], k);
}
