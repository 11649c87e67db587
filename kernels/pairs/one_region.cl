/* Lists the (region, seed) pairs of a domain of one region: every seed with region 0. */

/* Pair k is (seed k, region 0); seed k has the pairs offset[k] .. offset[k+1]. */
__kernel void pair_all(const uint count, __global uint* pair_seed, __global uint* pair_region,
                       __global ulong* offset) {
  const uint k = (uint)get_global_id(0);
  if (k > count) return;
  offset[k] = k;
  if (k == count) return;
  pair_seed[k] = k;
  pair_region[k] = 0;
}
