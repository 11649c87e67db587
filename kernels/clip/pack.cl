/* Compacts rows of a fixed capacity, so that the host reads only the used entries. */

/* Work-item t moves row t: offset[t + 1] - offset[t] entries of `words` 32-bit words each, from row t of
   `capacity` entries to entry offset[t]. */
__kernel void pack_rows(const uint rows, const uint capacity, const uint words, __global const uint* offset,
                        __global const uint* restrict from, __global uint* restrict to) {
  const uint t = (uint)get_global_id(0);
  if (t >= rows) return;
  const size_t first = (size_t)t * capacity * words, target = (size_t)offset[t] * words;
  const uint count = (offset[t + 1] - offset[t]) * words;
  for (uint k = 0; k < count; ++k) to[target + k] = from[first + k];
}
