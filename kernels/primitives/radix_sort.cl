/* One pass of a stable radix sort of (64-bit key, 32-bit value) pairs, least digit first. One
   work-item counts and moves a tile by itself, in order: no barrier, no local memory, and the same
   result for every number of tiles. RADIX_BITS: 8 suits few tiles (CPU), 4 many (GPU). */
#ifndef RADIX_BITS
#define RADIX_BITS 8
#endif
#define RADIX (1u << RADIX_BITS)

static inline uint digit_of(ulong key, uint shift) {
  return (uint)(key >> shift) & (RADIX - 1u);
}

/* counts[digit * tiles + t]: how often the digit occurs in tile t of `tile` pairs. */
__kernel void count_digits(const uint tiles, const uint tile, const uint count, const uint shift,
                           __global const ulong* keys, __global uint* counts) {
  const uint t = (uint)get_global_id(0);
  if (t >= tiles) return;
  uint found[RADIX];
  for (uint d = 0; d < RADIX; ++d) found[d] = 0;
  const uint begin = t * tile, end = begin + min(tile, count - begin);
  for (uint k = begin; k < end; ++k) ++found[digit_of(keys[k], shift)];
  for (uint d = 0; d < RADIX; ++d) counts[d * tiles + t] = found[d];
}

/* Moves tile t to where `places`, the prefix sums of the counts, has its digits begin. */
__kernel void scatter_by_digit(const uint tiles, const uint tile, const uint count, const uint shift,
                               __global const ulong* keys, __global const uint* values,
                               __global const uint* places, __global ulong* sorted_keys,
                               __global uint* sorted_values) {
  const uint t = (uint)get_global_id(0);
  if (t >= tiles) return;
  uint place[RADIX];
  for (uint d = 0; d < RADIX; ++d) place[d] = places[d * tiles + t];
  const uint begin = t * tile, end = begin + min(tile, count - begin);
  for (uint k = begin; k < end; ++k) {
    const ulong key = keys[k];
    const uint to = place[digit_of(key, shift)]++;
    sorted_keys[to] = key;
    sorted_values[to] = values[k];
  }
}
