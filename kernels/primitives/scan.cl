/* Exclusive prefix sums, in place. One work-item adds up a tile by itself: no barrier, no local memory,
   and integers, so the result cannot depend on how the device groups the work-items. */
#ifndef SCAN_BITS
#define SCAN_BITS 32
#endif
#if SCAN_BITS == 64
typedef ulong scan_t;
#else
typedef uint scan_t;
#endif

#define SCAN_TILE 128u

/* sums[t] = sum of tile t of the values. Both are parts of buffers that begin at `from` and `to`. */
__kernel void sum_tiles(const uint tiles, const uint count, __global const scan_t* values, const uint from,
                        __global scan_t* sums, const uint to) {
  const uint t = (uint)get_global_id(0);
  if (t >= tiles) return;
  const uint begin = t * SCAN_TILE, end = begin + min(SCAN_TILE, count - begin);
  scan_t sum = 0;
  for (uint k = begin; k < end; ++k) sum += values[from + k];
  sums[to + t] = sum;
}

/* Replaces each value by the sum of those before it. `sums`, scanned already, holds the sum before each tile;
   with one tile it is not read. */
__kernel void scan_tiles(const uint tiles, const uint count, __global scan_t* values, const uint from,
                         __global const scan_t* sums, const uint to) {
  const uint t = (uint)get_global_id(0);
  if (t >= tiles) return;
  const uint begin = t * SCAN_TILE, end = begin + min(SCAN_TILE, count - begin);
  scan_t sum = tiles > 1 ? sums[to + t] : (scan_t)0;
  for (uint k = begin; k < end; ++k) {
    const scan_t value = values[from + k];
    values[from + k] = sum;
    sum += value;
  }
}
