/* Sums the moments of the pairs of each seed, in the order of the pairs, so that the result has the
   same bits whatever the chunks and work-groups. */
#include "base/real.cl"

#define MOMENTS (2 + DIMENSION)

/* Work-item t adds the pairs offset[t] .. offset[t+1] of the chunk to row first + t of
   `sums`, after clearing it when `clear[t]` says that they are its first. */
__kernel void gather(const uint count, const uint first, __global const uint* offset,
                     __global const uint* clear, __global const stored_real* moments,
                     __global stored_real* sums) {
  const uint t = (uint)get_global_id(0);
  if (t >= count) return;
  for (uint k = 0; k < MOMENTS; ++k) {
    const size_t at = (size_t)(first + t) * MOMENTS + k;
    stored_real sum = clear[t] ? (stored_real)0 : sums[at];
    for (uint pair = offset[t]; pair < offset[t + 1]; ++pair) sum += moments[(size_t)pair * MOMENTS + k];
    sums[at] = sum;
  }
}
